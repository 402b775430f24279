#include "bake/atlas.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rnmbake {
namespace {

/// Fills shelves from the bottom, left to right; an atlas that the next tile would make too large is closed
/// and a new one begun.
class ShelfPacker {
 public:
  ShelfPacker(int width, std::int64_t max_pixels) : width_(width), max_pixels_(max_pixels) {}

  Placement place(const RectSize& tile) {
    if (x_ + tile.width > width_) next_shelf();
    if (top_ > 0 && !fits(tile)) next_atlas();
    const Placement placed{atlases_.size(), x_, y_};
    x_ += tile.width;
    used_width_ = std::max(used_width_, x_);
    top_ = std::max(top_, y_ + tile.height);
    return placed;
  }

  std::vector<RectSize> finish() {
    if (top_ > 0) next_atlas();
    return std::move(atlases_);
  }

 private:
  [[nodiscard]] bool fits(const RectSize& tile) const {
    return std::int64_t(std::max(used_width_, x_ + tile.width)) * std::max(top_, y_ + tile.height) <=
           max_pixels_;
  }
  void next_shelf() {
    x_ = 0;
    y_ = top_;
  }
  void next_atlas() {
    atlases_.push_back({used_width_, top_});
    x_ = y_ = top_ = used_width_ = 0;
  }

  std::vector<RectSize> atlases_;
  int width_;
  std::int64_t max_pixels_;
  int x_ = 0, y_ = 0, top_ = 0, used_width_ = 0;
};

/// The smallest power of two that makes the tiles about square, and never narrower than the widest.
int choose_width(const std::vector<RectSize>& tiles, std::int64_t max_pixels) {
  std::int64_t pixels = 0;
  int widest = 1;
  for (const RectSize& tile : tiles) {
    pixels += std::int64_t(tile.width) * tile.height;
    widest = std::max(widest, tile.width);
  }
  const double side = std::sqrt(static_cast<double>(std::min(pixels, max_pixels)));
  int width = 1;
  while (width < side) width *= 2;
  return std::max(width, widest);
}

}  // namespace

AtlasPlan pack(const std::vector<RectSize>& tiles, std::int64_t max_pixels) {
  std::vector<std::size_t> order(tiles.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return tiles[a].height > tiles[b].height; });
  ShelfPacker packer(choose_width(tiles, max_pixels), max_pixels);
  AtlasPlan plan;
  plan.placements.resize(tiles.size());
  for (const std::size_t tile : order) plan.placements[tile] = packer.place(tiles[tile]);
  plan.atlases = packer.finish();
  return plan;
}

}  // namespace rnmbake
