// unwrap/pack.h - lays charts out in the unit square, as large as they fit with a margin between them.
#pragma once

#include "scene/mesh.h"
#include "unwrap/charts.h"

#include <vector>

namespace rnmbake {

struct Packing {
  double scale = 0;           // shares of the side for a world unit
  std::vector<Vec2d> places;  // [charts], lower left, shares of the side
};

/// Places charts of falling height where their lower outline comes to lie deepest on the upper outlines of
/// those before ("Tetris" packing, Levy et al. 2002), at the largest scale of a few that are tried. Charts
/// keep `margin` (a share of the side) between them, along x or along y, and half of it to the border. Empty
/// where they cannot: too many charts for such a margin; never for a margin of 0.
[[nodiscard]] Packing pack(const Mesh& mesh, const Charts& charts, double margin);

}  // namespace rnmbake
