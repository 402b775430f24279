// unwrap/unwrap_mesh.h - lightmap UVs for a mesh, by its shape alone: the same on every machine.
#pragma once

#include "base/math.h"
#include "scene/mesh.h"
#include "unwrap/charts.h"

#include <cstddef>
#include <vector>

namespace rnmbake {

struct Unwrapping {
  std::vector<Vec2> uv;  // [loops] in [0,1]; (0, 0) for polygons without area
  double uv_area = 0;    // share of the square that charts cover
  double margin = 0;     // share of the side kept between charts
};

/// Packs with a margin (a share of the side). Where that leaves the charts next to nothing (under a fifth of
/// the square, and less than half of what they fill without a margin), it is halved until it does not.
[[nodiscard]] Unwrapping unwrap_charts(const Mesh& mesh, const Charts& charts, double margin);

}  // namespace rnmbake
