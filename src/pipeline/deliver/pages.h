// pipeline/deliver/pages.h - the maps of many objects on a few pictures that they share.
#pragma once

#include "bake/atlas.h"
#include "base/math.h"
#include "image/layered_exr.h"
#include "lightmap/texel_bits.h"
#include "pipeline/lightmaps/lightmap_folder.h"

#include <cstddef>
#include <string>
#include <vector>

namespace rnmbake {

/// Where an object's map has come to lie. Texels are counted from the top left.
struct PagedMap {
  std::string key;
  RectSize map;             // the object's own
  int left = 0, top = 0;    // texel of it that is the box's first; below 0 where padding reaches past it
  RectSize box;             // what surfaces are seen in, with the padding around
  TexelBits surface;        // texels of the box, without its padding, in which a surface is seen
  std::size_t covered = 0;  // of these, whose centre lies in a face
  std::size_t page = 0;
  int x = 0, y = 0;  // of the box's first texel, on the page

  /// From the object's own UVs to the page's: uv * scale + offset, with v downwards, as in glTF.
  [[nodiscard]] Imath::V2d scale(RectSize page_size) const;
  [[nodiscard]] Imath::V2d offset(RectSize page_size) const;
};

struct PageLimits {
  int side = 4096;     // texels
  int padding = 4;     // texels around surfaces that are filled from them
  bool alike = false;  // all pages get the size of the largest
};

struct PageLayout {
  std::vector<RectSize> pages;
  std::vector<PagedMap> maps;  // in the folder's order
  std::size_t covered = 0;     // texels, of all maps
  std::size_t taken = 0;       // of pages that are full: surfaces and their padding
  PageLimits limits;

  /// Over the covered texels; 1 would be perfect.
  [[nodiscard]] double texels_for_each_covered() const;
  /// The same of pages that are full: no packing has fewer.
  [[nodiscard]] double least_for_each_covered() const;
  /// Share of the page's texels whose centre lies in a face.
  [[nodiscard]] double covered_share(std::size_t page) const;
};

/// Places maps by the texels that their surfaces are seen in, and `padding` around, so that they lie in each
/// other's holes and no texel has two of them. `uvs`: for each of the folder's maps three UVs for each
/// triangle, v up, without which only covered texels count. The same maps are laid out the same everywhere.
/// Throws Error(unsupported) naming an object that is larger than a page, else as load_lightmap().
[[nodiscard]] PageLayout lay_out_pages(const LightmapFolder& folder, const PageLimits& limits,
                                       const std::vector<std::vector<Vec2>>& uvs = {});

/// One page of a folder's maps.
struct Page {
  std::vector<Layer> layers;  // RGB; texels that are not covered are filled from their own map's
  FloatImage coverage;        // 1 where the texel's centre lies in a face: what was baked
  FloatImage seen = {};       // 1 where a surface is seen
  FloatImage filled = {};     // 1 there and in the padding
};

/// The layers of these names, in their order. Throws Error(invalid_input) where a map lacks one.
[[nodiscard]] Page compose_page(const LightmapFolder& folder, const PageLayout& layout, std::size_t page,
                                const std::vector<std::string>& layers);

}  // namespace rnmbake
