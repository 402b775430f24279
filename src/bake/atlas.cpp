#include "bake/atlas.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
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

/// Adds an atlas of those that were placed; gives the others back.
std::vector<stbrp_rect> take_placed(AtlasPlan& plan, const std::vector<stbrp_rect>& rects, RectSize size) {
  std::vector<stbrp_rect> left;
  for (const stbrp_rect& rect : rects) {
    if (rect.was_packed == 0) {
      left.push_back(rect);
    } else {
      plan.placements[static_cast<std::size_t>(rect.id)] = {plan.atlases.size(), rect.x, rect.y};
    }
  }
  plan.atlases.push_back(size);
  return left;
}

/// Adds one atlas with as many of the rectangles as fit; gives the others back. The widest always fits, since
/// no rectangle has more pixels than the limit.
std::vector<stbrp_rect> fill_atlas(AtlasPlan& plan, std::vector<stbrp_rect> rects, std::int64_t max_pixels) {
  const int width = choose_width(rects, max_pixels);
  const RectSize used = place(rects, {width, static_cast<int>(max_pixels / width)});
  return take_placed(plan, rects, used);
}

bool all_placed(const std::vector<stbrp_rect>& rects) {
  return std::ranges::all_of(rects, [](const stbrp_rect& rect) { return rect.was_packed != 0; });
}

constexpr int tried_widths = 64, block_side = 4;

/// Texels, a tenth more for each time that the page is longer than wide, or wider than long.
double cost_of(RectSize size) {
  const auto [shorter, longer] = std::minmax(size.width, size.height);
  return double(size.width) * size.height * (1 + 0.1 * (double(longer) / shorter - 1));
}

/// Adds the smallest page that holds all of the rectangles, or a whole one with as many as fit; gives the
/// others back.
std::vector<stbrp_rect> fill_page(AtlasPlan& plan, const std::vector<stbrp_rect>& rects, int side) {
  const auto rounded = [&](int length) {
    return std::min((length + block_side - 1) / block_side * block_side, side);
  };
  std::vector<stbrp_rect> best;
  RectSize smallest{side, side};
  for (int i = 1; i <= tried_widths; ++i) {
    const int width = rounded(side * i / tried_widths);
    if (std::ranges::any_of(rects, [&](const stbrp_rect& rect) { return rect.w > width; })) continue;
    std::vector<stbrp_rect> placed = rects;
    const RectSize used = place(placed, {width, side});
    const RectSize size{rounded(used.width), rounded(used.height)};
    if (!all_placed(placed) && width < side) continue;
    if (best.empty() || cost_of(size) < cost_of(smallest)) {
      best = std::move(placed);
      smallest = size;
    }
  }
  return take_placed(plan, best, smallest);
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

AtlasPlan pack_pages(const std::vector<RectSize>& rects, int side) {
  AtlasPlan plan;
  plan.placements.resize(rects.size());
  std::vector<stbrp_rect> left;
  for (std::size_t i = 0; i < rects.size(); ++i) {
    if (rects[i].width > side || rects[i].height > side)
      throw std::invalid_argument("a rectangle is larger than a page");
    left.push_back({static_cast<int>(i), rects[i].width, rects[i].height, 0, 0, 0});
  }
  while (!left.empty()) left = fill_page(plan, left, side);
  return plan;
}

}  // namespace rnmbake
