#include "lightmap/mask_pack.h"

#include "lightmap/mask_board.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

namespace rnmbake {
namespace {

constexpr int block_side = 4;
constexpr std::uint64_t most_effort = 500'000'000;  // words of a page's trials: about a second

/// Widths that are tried, over the side of a square of the masks' texels: `likely_width` and others on both
/// sides of it, further and further off.
constexpr double likely_width = 1.12, width_step = 0.02;
constexpr int tried_widths = 61;

using Order = std::vector<std::size_t>;

/// Texels, a tenth more for each time that the page is longer than wide, or wider than long.
double cost_of(const MaskPlan::Page& page) {
  const auto [shorter, longer] = std::minmax(page.width, page.height);
  return double(page.width) * page.height * (1 + 0.1 * (double(longer) / shorter - 1));
}

/// One page with what fits on it.
struct Trial {
  MaskPlan::Page page;
  std::vector<std::pair<std::size_t, MaskBoard::Spot>> placed;  // masks
  std::size_t texels = 0;                                       // of these
};

class Packer {
 public:
  Packer(const std::vector<TexelBits>& masks, int side) : masks_(masks), side_(side) {
    for (const TexelBits& mask : masks) {
      if (mask.width() > side || mask.height() > side)
        throw std::invalid_argument("a mask is larger than a page");
      runs_.emplace_back(mask);
      texels_.push_back(mask.count());
    }
  }

  MaskPlan pack() {
    MaskPlan plan;
    plan.places.resize(masks_.size());
    Order left(masks_.size());
    std::iota(left.begin(), left.end(), std::size_t{0});
    while (!left.empty()) {
      const Trial trial = fill_page(left);
      for (const auto& [mask, spot] : trial.placed) {
        plan.places[mask] = {plan.pages.size(), spot.x, spot.y};
        std::erase(left, mask);
      }
      plan.pages.push_back(trial.page);
    }
    return plan;
  }

 private:
  [[nodiscard]] int rounded(int length) const {
    return std::min((length + block_side - 1) / block_side * block_side, side_);
  }

  Trial fill_page(const Order& left) {
    effort_ = 0;
    const std::vector<Order> orders = orders_of(left);
    std::optional<Trial> best;
    for (const int width : widths_for(left)) {
      for (const Order& order : orders) {
        if (effort_ > most_effort && best) return *best;
        if (effort_ > most_effort) break;
        const int rows = best ? rows_below(width, cost_of(best->page)) : side_;
        Trial trial = fill(order, width, rows, true);
        if (trial.placed.size() == left.size()) best = std::move(trial);
      }
    }
    return best ? *best : fullest(orders);
  }

  /// Of pages of all that a page may have.
  Trial fullest(const std::vector<Order>& orders) {
    Trial best;
    effort_ = 0;
    for (const Order& order : orders) {
      if (effort_ > most_effort) break;
      Trial trial = fill(order, side_, side_, false);
      if (trial.texels > best.texels) best = std::move(trial);
    }
    return best;
  }

  /// Places the masks one after the other; `all`: ends with the first that has no place.
  Trial fill(const Order& order, int width, int rows, bool all) {
    MaskBoard board(width, rows);
    Trial trial;
    std::size_t before = masks_.size();
    std::optional<MaskBoard::Spot> spot;
    for (const std::size_t mask : order) {
      const bool alike = before < masks_.size() && masks_[before] == masks_[mask];
      if (!alike || spot) spot = board.find(runs_[mask], alike ? spot->y : 0);
      before = mask;
      if (!spot && all) break;
      if (!spot) continue;
      board.put(runs_[mask], *spot);
      trial.placed.emplace_back(mask, *spot);
      trial.texels += texels_[mask];
    }
    effort_ += board.effort();
    trial.page = {width, rounded(board.used_rows())};
    return trial;
  }

  /// By what makes masks hard to place, hardest first.
  [[nodiscard]] std::vector<Order> orders_of(const Order& left) const {
    const std::array<std::function<std::size_t(std::size_t)>, 4> keys{
        [&](std::size_t i) { return texels_[i]; },
        [&](std::size_t i) { return std::size_t(masks_[i].width()) * masks_[i].height(); },
        [&](std::size_t i) { return std::size_t(masks_[i].height()); },
        [&](std::size_t i) { return std::size_t(std::max(masks_[i].width(), masks_[i].height())); }};
    std::vector<Order> orders;
    for (const auto& key : keys) {
      orders.push_back(left);
      std::ranges::stable_sort(orders.back(), std::ranges::greater(), key);
    }
    return orders;
  }

  /// None where the masks have more texels than a page.
  [[nodiscard]] std::vector<int> widths_for(const Order& left) const {
    std::size_t texels = 0;
    int widest = 0;
    for (const std::size_t mask : left) {
      texels += texels_[mask];
      widest = std::max(widest, masks_[mask].width());
    }
    std::vector<int> found;
    if (texels > std::size_t(side_) * side_) return found;
    for (int i = 0; i < tried_widths; ++i) {
      const double factor = likely_width + width_step * ((i + 1) / 2) * (i % 2 == 0 ? 1 : -1);
      const int width = rounded(std::max(widest, static_cast<int>(factor * std::sqrt(double(texels)))));
      if (std::ranges::find(found, width) == found.end()) found.push_back(width);
    }
    if (std::ranges::find(found, side_) == found.end()) found.push_back(side_);
    return found;
  }

  /// The most rows of a page that costs less.
  [[nodiscard]] int rows_below(int width, double cost) const {
    int rows = side_;
    while (rows > 0 && cost_of({width, rounded(rows)}) >= cost) --rows;
    return rows;
  }

  const std::vector<TexelBits>& masks_;
  int side_;
  std::vector<MaskRuns> runs_;
  std::vector<std::size_t> texels_;
  std::uint64_t effort_ = 0;
};

}  // namespace

MaskPlan pack_masks(const std::vector<TexelBits>& masks, int side) {
  return Packer(masks, side).pack();
}

}  // namespace rnmbake
