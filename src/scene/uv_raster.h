// scene/uv_raster.h - which triangle owns which texel, by the rule that Cycles bakes with.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <vector>

namespace rnmbake {

/// A texel is owned by the last triangle whose UV polygon holds the texel's centre.
struct TexelOwner {
  std::int32_t triangle = -1;  // position in the list given to rasterize(), -1: none
  float b1 = 0, b2 = 0;        // barycentric weights of corners 1 and 2 at the texel's centre
};

struct UvRaster {
  int width = 0, height = 0;
  std::vector<TexelOwner> owners;     // [width x height], row 0 on top
  std::vector<std::uint16_t> layers;  // how many triangles hold each texel's centre; > 1: overlap

  [[nodiscard]] const TexelOwner& at(int x, int y) const { return owners[std::size_t(y) * width + x]; }
};

/// `corner_uv`: three UVs for each triangle, v up, [0,1] is the picture. What lies outside is clipped away.
[[nodiscard]] UvRaster rasterize(const std::vector<Vec2>& corner_uv, int width, int height);

}  // namespace rnmbake
