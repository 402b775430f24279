#include "pipeline/deliver/pages.h"

#include "base/error.h"
#include "lightmap/fill.h"

#include <algorithm>
#include <limits>

namespace rnmbake {
namespace {

const FloatImage& coverage_of(const LoadedLightmap& loaded) {
  const Layer* coverage = loaded.image.find("coverage");
  if (coverage == nullptr)
    fail(ExitCode::invalid_input, "{} has no layer 'coverage'; bake it again", loaded.file);
  return coverage->pixels;
}

/// The box of what is covered, and the number of covered texels; 1 x 1 where nothing is.
std::size_t crop(const FloatImage& coverage, int padding, PagedMap& map) {
  int left = coverage.width(), top = coverage.height(), right = -1, bottom = -1;
  std::size_t covered = 0;
  for (int y = 0; y < coverage.height(); ++y) {
    for (int x = 0; x < coverage.width(); ++x) {
      if (coverage.texel(x, y)[0] <= 0.5F) continue;
      ++covered;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  if (covered == 0) left = top = right = bottom = 0;
  map.left = left - padding;
  map.top = top - padding;
  map.box = {right - left + 1 + 2 * padding, bottom - top + 1 + 2 * padding};
  return covered;
}

/// Covered texels alone: what was dilated within the map belongs to another layout.
void copy_covered(const FloatImage& from, const FloatImage& coverage, const PagedMap& map, FloatImage& page) {
  for (int y = std::max(map.top, 0); y < std::min(map.top + map.box.height, from.height()); ++y) {
    for (int x = std::max(map.left, 0); x < std::min(map.left + map.box.width, from.width()); ++x) {
      if (coverage.texel(x, y)[0] > 0.5F)
        std::ranges::copy(from.texel(x, y), page.texel(map.x + x - map.left, map.y + y - map.top).begin());
    }
  }
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
  for (const RectSize& page : pages) texels += std::size_t(page.width) * page.height;
  return covered == 0 ? std::numeric_limits<double>::infinity() : double(texels) / double(covered);
}

PageLayout lay_out_pages(const LightmapFolder& folder, const PageLimits& limits) {
  PageLayout layout;
  layout.limits = limits;
  std::vector<RectSize> boxes;
  for (const LightmapPlace& place : folder.places) {
    const LoadedLightmap loaded = load_lightmap(place);
    const FloatImage& coverage = coverage_of(loaded);
    PagedMap map;
    map.key = place.key;
    map.map = {coverage.width(), coverage.height()};
    layout.covered += crop(coverage, limits.padding, map);
    if (map.box.width > limits.side || map.box.height > limits.side) {
      fail(ExitCode::unsupported,
           "{}: its map takes {} x {} texels with {} of padding, more than a page of {}; raise --pages, or "
           "bake it "
           "at a lower resolution",
           place.key, map.box.width, map.box.height, limits.padding, limits.side);
    }
    boxes.push_back(map.box);
    layout.maps.push_back(std::move(map));
  }
  const AtlasPlan plan = pack_pages(boxes, limits.side);
  layout.pages = plan.atlases;
  if (limits.alike) make_alike(layout.pages);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    layout.maps[i].page = plan.placements[i].atlas;
    layout.maps[i].x = plan.placements[i].x;
    layout.maps[i].y = plan.placements[i].y;
  }
  return layout;
}

Page compose_page(const LightmapFolder& folder, const PageLayout& layout, std::size_t page,
                  const std::vector<std::string>& layers) {
  const RectSize size = layout.pages[page];
  Page composed{{}, {size.width, size.height, 1}};
  for (const std::string& name : layers)
    composed.layers.push_back({name, {"R", "G", "B"}, {size.width, size.height, 3}});
  for (const PagedMap& map : layout.maps) {
    if (map.page != page) continue;
    const LoadedLightmap loaded = load_lightmap(*folder.find(map.key));
    const FloatImage& coverage = coverage_of(loaded);
    copy_covered(coverage, coverage, map, composed.coverage);
    for (Layer& layer : composed.layers) {
      const Layer* own = loaded.image.find(layer.name);
      if (own == nullptr || own->channels != layer.channels)
        fail(ExitCode::invalid_input,
             "{} has no layer '{}', which other maps have; bake all with the same settings", loaded.file,
             layer.name);
      copy_covered(own->pixels, coverage, map, layer.pixels);
    }
  }
  for (Layer& layer : composed.layers) dilate(layer.pixels, composed.coverage, layout.limits.padding);
  return composed;
}

}  // namespace rnmbake
