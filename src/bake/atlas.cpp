#include "bake/atlas.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rnmbake {
namespace {

/// Fills shelves from the bottom, left to right; an atlas that the next rectangle would make too large is
/// closed and a new one begun.
class ShelfPacker {
 public:
  ShelfPacker(int width, std::int64_t max_pixels) : width_(width), max_pixels_(max_pixels) {}

  Placement place(const RectSize& rect) {
    if (x_ + rect.width > width_) next_shelf();
    if (top_ > 0 && !fits(rect)) next_atlas();
    const Placement placed{atlases_.size(), x_, y_};
    x_ += rect.width;
    used_width_ = std::max(used_width_, x_);
    top_ = std::max(top_, y_ + rect.height);
    return placed;
  }

  std::vector<RectSize> finish() {
    if (top_ > 0) next_atlas();
    return std::move(atlases_);
  }

 private:
  [[nodiscard]] bool fits(const RectSize& rect) const {
    return std::int64_t(std::max(used_width_, x_ + rect.width)) * std::max(top_, y_ + rect.height) <=
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

/// The smallest power of two that makes the rectangles about square, and never narrower than the widest.
int choose_width(const std::vector<RectSize>& rects, std::int64_t max_pixels) {
  std::int64_t pixels = 0;
  int widest = 1;
  for (const RectSize& rect : rects) {
    pixels += std::int64_t(rect.width) * rect.height;
    widest = std::max(widest, rect.width);
  }
  const double side = std::sqrt(static_cast<double>(std::min(pixels, max_pixels)));
  int width = 1;
  while (width < side) width *= 2;
  return std::max(width, widest);
}

}  // namespace

AtlasPlan pack(const std::vector<RectSize>& rects, std::int64_t max_pixels) {
  std::vector<std::size_t> order(rects.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rects[a].height > rects[b].height; });
  ShelfPacker packer(choose_width(rects, max_pixels), max_pixels);
  AtlasPlan plan;
  plan.placements.resize(rects.size());
  for (const std::size_t rect : order) plan.placements[rect] = packer.place(rects[rect]);
  plan.atlases = packer.finish();
  return plan;
}

}  // namespace rnmbake
