#include "unwrap/unwrap_mesh.h"

#include "unwrap/pack.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

constexpr double least_area = 0.2;     // of the square
constexpr double least_margin = 1e-4;  // of the side; narrower is none
constexpr double least_share = 0.5;    // of the area without a margin

/// World area that the charts cover in the plane.
double flat_area(const Mesh& mesh, const Charts& charts) {
  double sum = 0;
  for (std::size_t corner = 0; corner + 2 < mesh.triangle_loops.size(); corner += 3) {
    const auto* loops = &mesh.triangle_loops[corner];
    const Vec2d &a = charts.at[loops[0]], &b = charts.at[loops[1]], &c = charts.at[loops[2]];
    sum += 0.5 * std::abs((b - a) % (c - a));
  }
  return sum;
}

Packing pack_usefully(const Mesh& mesh, const Charts& charts, double area, double& margin) {
  const auto filled = [&](const Packing& packing) { return area * packing.scale * packing.scale; };
  Packing packing = pack(mesh, charts, margin);
  if (margin == 0 || filled(packing) >= least_area) return packing;
  Packing tight = pack(mesh, charts, 0);
  while (filled(packing) < least_area && filled(packing) < least_share * filled(tight)) {
    margin /= 2;
    if (margin < least_margin) {
      margin = 0;
      return tight;
    }
    packing = pack(mesh, charts, margin);
  }
  return packing;
}

}  // namespace

Unwrapping unwrap_charts(const Mesh& mesh, const Charts& charts, double margin) {
  Unwrapping result;
  result.uv.assign(mesh.loop_vertex.size(), Vec2(0, 0));
  result.margin = margin;
  if (charts.charts.empty()) return result;
  const double area = flat_area(mesh, charts);
  const Packing packing = pack_usefully(mesh, charts, area, result.margin);
  result.uv_area = area * packing.scale * packing.scale;
  for (std::size_t i = 0; i < charts.charts.size(); ++i) {
    for (const std::uint32_t polygon : charts.charts[i].polygons) {
      const std::uint32_t start = mesh.polygon_start[polygon];
      for (std::uint32_t loop = start; loop < start + mesh.polygon_size[polygon]; ++loop)
        result.uv[loop] = Vec2(packing.places[i] + charts.at[loop] * packing.scale);
    }
  }
  return result;
}

}  // namespace rnmbake
