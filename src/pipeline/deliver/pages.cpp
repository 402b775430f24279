#include "pipeline/deliver/pages.h"

#include "base/error.h"
#include "lightmap/fill.h"
#include "lightmap/mask_pack.h"
#include "lightmap/touched.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace rnmbake {
namespace {

const FloatImage& coverage_of(const LoadedLightmap& loaded) {
  const Layer* coverage = loaded.image.find("coverage");
  if (coverage == nullptr)
    fail(ExitCode::invalid_input, "{} has no layer 'coverage'; bake it again", loaded.file);
  return coverage->pixels;
}

/// Texels of a map in which a surface is seen.
TexelBits surface_of(const FloatImage& coverage, const std::vector<Vec2>& uvs, PagedMap& map) {
  TexelBits seen(coverage.width(), coverage.height());
  for (int y = 0; y < coverage.height(); ++y) {
    for (int x = 0; x < coverage.width(); ++x) {
      if (coverage.texel(x, y)[0] <= 0.5F) continue;
      seen.set(x, y);
      ++map.covered;
    }
  }
  set_touched(uvs, seen);
  return seen;
}

/// Cuts the map to the box of what is seen; 1 x 1 where nothing is.
void crop(const TexelBits& seen, int padding, PagedMap& map) {
  int left = seen.width(), top = seen.height(), right = -1, bottom = -1;
  for (int y = 0; y < seen.height(); ++y) {
    for (int x = 0; x < seen.width(); ++x) {
      if (!seen.at(x, y)) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  if (right < 0) left = top = right = bottom = 0;
  map.surface = {right - left + 1, bottom - top + 1};
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x)
      if (seen.at(x, y)) map.surface.set(x - left, y - top);
  }
  map.left = left - padding;
  map.top = top - padding;
  map.box = {map.surface.width() + 2 * padding, map.surface.height() + 2 * padding};
}

/// Covered texels alone: what was dilated within the map may be less than its surfaces are seen in.
FloatImage covered_box(const FloatImage& from, const FloatImage& coverage, const PagedMap& map) {
  FloatImage box(map.box.width, map.box.height, from.channels());
  for (int y = std::max(map.top, 0); y < std::min(map.top + map.box.height, from.height()); ++y) {
    for (int x = std::max(map.left, 0); x < std::min(map.left + map.box.width, from.width()); ++x) {
      if (coverage.texel(x, y)[0] > 0.5F)
        std::ranges::copy(from.texel(x, y), box.texel(x - map.left, y - map.top).begin());
    }
  }
  return box;
}

/// Copies those texels of the box that are the map's on the page.
void put_on_page(const FloatImage& box, const TexelBits& own, const PagedMap& map, FloatImage& page) {
  for (int y = 0; y < own.height(); ++y) {
    for (int x = 0; x < own.width(); ++x)
      if (own.at(x, y)) std::ranges::copy(box.texel(x, y), page.texel(map.x + x, map.y + y).begin());
  }
}

void set_bits(const TexelBits& bits, int left, int top, FloatImage& page) {
  for (int y = 0; y < bits.height(); ++y) {
    for (int x = 0; x < bits.width(); ++x)
      if (bits.at(x, y)) page.texel(left + x, top + y)[0] = 1;
  }
}

double over(std::size_t texels, std::size_t covered) {
  return covered == 0 ? std::numeric_limits<double>::infinity() : double(texels) / double(covered);
}

std::size_t texels_of(const RectSize& page) {
  return std::size_t(page.width) * page.height;
}

void make_alike(std::vector<RectSize>& pages) {
  RectSize all{0, 0};
  for (const RectSize& page : pages)
    all = {std::max(all.width, page.width), std::max(all.height, page.height)};
  std::ranges::fill(pages, all);
}

}  // namespace

Imath::V2d PagedMap::scale(RectSize page_size) const {
  return {double(map.width) / page_size.width, double(map.height) / page_size.height};
}

Imath::V2d PagedMap::offset(RectSize page_size) const {
  return {double(x - left) / page_size.width, double(y - top) / page_size.height};
}

double PageLayout::texels_for_each_covered() const {
  std::size_t texels = 0;
  for (const RectSize& page : pages) texels += texels_of(page);
  return over(texels, covered);
}

double PageLayout::least_for_each_covered() const {
  return over(taken, covered);
}

double PageLayout::covered_share(std::size_t page) const {
  std::size_t on_it = 0;
  for (const PagedMap& map : maps)
    if (map.page == page) on_it += map.covered;
  return double(on_it) / double(texels_of(pages[page]));
}

PageLayout lay_out_pages(const LightmapFolder& folder, const PageLimits& limits,
                         const std::vector<std::vector<Vec2>>& uvs) {
  PageLayout layout;
  layout.limits = limits;
  std::vector<TexelBits> masks;
  for (std::size_t i = 0; i < folder.places.size(); ++i) {
    const LoadedLightmap loaded = load_lightmap(folder.places[i]);
    const FloatImage& coverage = coverage_of(loaded);
    PagedMap map;
    map.key = folder.places[i].key;
    map.map = {coverage.width(), coverage.height()};
    crop(surface_of(coverage, uvs.empty() ? std::vector<Vec2>() : uvs[i], map), limits.padding, map);
    if (map.box.width > limits.side || map.box.height > limits.side) {
      fail(ExitCode::unsupported,
           "{}: its map takes {} x {} texels with {} of padding, more than a page of {}; raise --pages, or "
           "bake it "
           "at a lower resolution",
           map.key, map.box.width, map.box.height, limits.padding, limits.side);
    }
    masks.push_back(grown(map.surface, limits.padding));
    layout.covered += map.covered;
    layout.taken += masks.back().count();
    layout.maps.push_back(std::move(map));
  }
  const MaskPlan plan = pack_masks(masks, limits.side);
  for (const MaskPlan::Page& page : plan.pages) layout.pages.push_back({page.width, page.height});
  if (limits.alike) make_alike(layout.pages);
  for (std::size_t i = 0; i < masks.size(); ++i) {
    layout.maps[i].page = plan.places[i].page;
    layout.maps[i].x = plan.places[i].x;
    layout.maps[i].y = plan.places[i].y;
  }
  return layout;
}

Page compose_page(const LightmapFolder& folder, const PageLayout& layout, std::size_t page,
                  const std::vector<std::string>& layers) {
  const RectSize size = layout.pages[page];
  const FloatImage empty(size.width, size.height, 1);
  Page composed{{}, empty, empty, empty};
  for (const std::string& name : layers)
    composed.layers.push_back({name, {"R", "G", "B"}, {size.width, size.height, 3}});
  for (const PagedMap& map : layout.maps) {
    if (map.page != page) continue;
    const LoadedLightmap loaded = load_lightmap(*folder.find(map.key));
    const FloatImage& coverage = coverage_of(loaded);
    const FloatImage covered = covered_box(coverage, coverage, map);
    const TexelBits own = grown(map.surface, layout.limits.padding);
    put_on_page(covered, own, map, composed.coverage);
    set_bits(map.surface, map.x + layout.limits.padding, map.y + layout.limits.padding, composed.seen);
    set_bits(own, map.x, map.y, composed.filled);
    for (Layer& layer : composed.layers) {
      const Layer* found = loaded.image.find(layer.name);
      if (found == nullptr || found->channels != layer.channels)
        fail(ExitCode::invalid_input,
             "{} has no layer '{}', which other maps have; bake all with the same settings", loaded.file,
             layer.name);
      FloatImage box = covered_box(found->pixels, coverage, map);
      dilate_everywhere(box, covered);
      put_on_page(box, own, map, layer.pixels);
    }
  }
  return composed;
}

}  // namespace rnmbake
