// unwrap/charts.h - cuts a mesh into patches that lie flat without overlaps.
#pragma once

#include "base/math.h"
#include "scene/mesh.h"

#include <cstdint>
#include <vector>

namespace rnmbake {

using Vec2d = Imath::V2d;

/// Connected polygons, seen along the normal of the largest of them and turned to the smallest upright
/// rectangle.
struct Chart {
  std::vector<std::uint32_t> polygons;
  Vec2d size{0, 0};  // world units; the height is the longer side
};

struct Charts {
  std::vector<Chart> charts;
  std::vector<Vec2d> at;  // [loops], world units from the chart's lower left; 0 for polygons without a chart
  double world_area = 0;  // of the triangles that lie in charts
};

/// The largest angle between a polygon and its chart: lengths shrink by its cosine at most.
inline constexpr double widest_angle = pi / 4;

/// Every polygon that has area gets into one chart. Polygons join over edges that two of them share, places
/// counting and not vertex numbers. No two cover the same sample of a grid twice as fine as `side` texels
/// would be if the charts filled them. Takes time in proportion to polygons and samples.
[[nodiscard]] Charts make_charts(const Mesh& mesh, const Mat44& to_world, int side);

}  // namespace rnmbake
