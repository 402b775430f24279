// pipeline/deliver/pages.h - the maps of many objects on a few pictures that they share.
#pragma once

#include "bake/atlas.h"
#include "base/math.h"
#include "image/layered_exr.h"
#include "pipeline/lightmaps/lightmap_folder.h"

#include <cstddef>
#include <string>
#include <vector>

namespace rnmbake {

/// Where an object's map has come to lie. Texels are counted from the top left.
struct PagedMap {
  std::string key;
  RectSize map;           // the object's own
  int left = 0, top = 0;  // texel of it that is the box's first; below 0 where padding reaches past it
  RectSize box;           // what covers it, with the padding around
  std::size_t page = 0;
  int x = 0, y = 0;  // of the box's first texel, on the page

  /// From the object's own UVs to the page's: uv * scale + offset, with v downwards, as in glTF.
  [[nodiscard]] Imath::V2d scale(RectSize page_size) const;
  [[nodiscard]] Imath::V2d offset(RectSize page_size) const;
};

struct PageLimits {
  int side = 4096;     // texels
  int padding = 4;     // texels around each map that are filled from it
  bool alike = false;  // all pages get the size of the largest
};

struct PageLayout {
  std::vector<RectSize> pages;
  std::vector<PagedMap> maps;  // in the folder's order
  std::size_t covered = 0;     // texels, of all maps
  PageLimits limits;

  /// Over the covered texels; 1 would be perfect.
  [[nodiscard]] double texels_for_each_covered() const;
};

/// Crops each map to its covered texels and places them. The same maps are laid out the same everywhere.
/// Throws Error(unsupported) naming an object that is larger than a page, else as load_lightmap().
[[nodiscard]] PageLayout lay_out_pages(const LightmapFolder& folder, const PageLimits& limits);

/// One page of a folder's maps.
struct Page {
  std::vector<Layer> layers;  // RGB; texels around the covered ones are filled from these
  FloatImage coverage;
};

/// The layers of these names, in their order. Throws Error(invalid_input) where a map lacks one.
[[nodiscard]] Page compose_page(const LightmapFolder& folder, const PageLayout& layout, std::size_t page,
                                const std::vector<std::string>& layers);

}  // namespace rnmbake
