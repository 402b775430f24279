#include "bake/atlas.h"

#include <algorithm>
#include <cmath>
#include <utility>

#define STBRP_STATIC
#include <stb_rect_pack.h>

namespace {

/// In place of qsort, whose order of equal rectangles differs between C libraries: pictures would, too.
void sort_rects(stbrp_rect* rects, int count, std::size_t, int (*compare)(const void*, const void*)) {
  std::stable_sort(rects, rects + count,
                   [&](const stbrp_rect& a, const stbrp_rect& b) { return compare(&a, &b) < 0; });
}

}  // namespace

#define STBRP_SORT sort_rects
#define STB_RECT_PACK_IMPLEMENTATION
#include <stb_rect_pack.h>

namespace rnmbake {
namespace {

constexpr std::int64_t most_pixels = 1 << 30;  // stb_rect_pack counts areas in an int

std::int64_t pixels_of(const stbrp_rect& rect) {
  return std::int64_t(rect.w) * rect.h;
}

/// The smallest power of two that makes the rectangles about square; narrower where the tallest would not fit
/// below the limit otherwise, but never narrower than the widest.
int choose_width(const std::vector<stbrp_rect>& rects, std::int64_t max_pixels) {
  std::int64_t pixels = 0, widest = 1, tallest = 1;
  for (const stbrp_rect& rect : rects) {
    pixels += pixels_of(rect);
    widest = std::max<std::int64_t>(widest, rect.w);
    tallest = std::max<std::int64_t>(tallest, rect.h);
  }
  const double side = std::sqrt(static_cast<double>(std::min(pixels, max_pixels)));
  std::int64_t width = 1;
  while (static_cast<double>(width) < side) width *= 2;
  return static_cast<int>(std::max(std::min(width, max_pixels / tallest), widest));
}

/// Places as many of the rectangles as fit; returns the size that they take.
RectSize place(std::vector<stbrp_rect>& rects, RectSize limit) {
  std::vector<stbrp_node> nodes(static_cast<std::size_t>(limit.width));
  stbrp_context context;
  stbrp_init_target(&context, limit.width, limit.height, nodes.data(), limit.width);
  stbrp_pack_rects(&context, rects.data(), static_cast<int>(rects.size()));
  RectSize used;
  for (const stbrp_rect& rect : rects) {
    if (rect.was_packed != 0)
      used = {std::max(used.width, rect.x + rect.w), std::max(used.height, rect.y + rect.h)};
  }
  return used;
}

/// Adds one atlas with as many of the rectangles as fit; gives the others back. The widest always fits, since
/// no rectangle has more pixels than the limit.
std::vector<stbrp_rect> fill_atlas(AtlasPlan& plan, std::vector<stbrp_rect> rects, std::int64_t max_pixels) {
  const int width = choose_width(rects, max_pixels);
  const RectSize used = place(rects, {width, static_cast<int>(max_pixels / width)});
  std::vector<stbrp_rect> left;
  for (const stbrp_rect& rect : rects) {
    if (rect.was_packed == 0) {
      left.push_back(rect);
    } else {
      plan.placements[static_cast<std::size_t>(rect.id)] = {plan.atlases.size(), rect.x, rect.y};
    }
  }
  plan.atlases.push_back(used);
  return left;
}

}  // namespace

AtlasPlan pack(const std::vector<RectSize>& rects, std::int64_t max_pixels) {
  max_pixels = std::min(max_pixels, most_pixels);
  AtlasPlan plan;
  plan.placements.resize(rects.size());
  std::vector<stbrp_rect> left;
  for (std::size_t i = 0; i < rects.size(); ++i) {
    const stbrp_rect rect{static_cast<int>(i), rects[i].width, rects[i].height, 0, 0, 0};
    if (pixels_of(rect) < max_pixels) {
      left.push_back(rect);
    } else {
      plan.placements[i] = {plan.atlases.size(), 0, 0};
      plan.atlases.push_back(rects[i]);
    }
  }
  while (!left.empty()) left = fill_atlas(plan, std::move(left), max_pixels);
  return plan;
}

}  // namespace rnmbake
