#include "scene/uv_report.h"

#include "scene/disjoint_sets.h"
#include "scene/flat_triangle.h"
#include "scene/uv_raster.h"
#include "scene/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

namespace rnmbake {
namespace {

constexpr float border_slack = 1e-5F;  // what unwrapping leaves beyond the border by rounding

struct TriangleAreas {
  double uv = 0;  // signed: negative where the UVs are mirrored
  double world = 0;
  bool flat_uv = false, flat_world = false;
};

double cross(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (double{b.x} - a.x) * (double{c.y} - a.y) - (double{b.y} - a.y) * (double{c.x} - a.x);
}

TriangleAreas areas_of(const Mesh& mesh, std::size_t triangle, const Vec2* uv, const Mat44& to_world) {
  const TriangleShape shape = triangle_shape(mesh, triangle, to_world);
  TriangleAreas areas;
  areas.world = shape.area;
  areas.flat_world = shape.flat();
  areas.uv = 0.5 * cross(uv[0], uv[1], uv[2]);
  const double longest2 =
      std::max({(uv[1] - uv[0]).length2(), (uv[2] - uv[0]).length2(), (uv[2] - uv[1]).length2()});
  areas.flat_uv = is_flat(std::abs(areas.uv), longest2);
  return areas;
}

bool outside(const Vec2& uv) {
  return uv.x < -border_slack || uv.y < -border_slack || uv.x > 1 + border_slack || uv.y > 1 + border_slack;
}

/// Wholly within one square of the grid that is not [0,1] x [0,1]: a UDIM tile.
bool in_another_tile(const Vec2* uv) {
  const Vec2 middle = (uv[0] + uv[1] + uv[2]) / 3.0F;
  const Vec2 tile(std::floor(middle.x), std::floor(middle.y));
  if (tile == Vec2(0, 0)) return false;
  return !outside(uv[0] - tile) && !outside(uv[1] - tile) && !outside(uv[2] - tile);
}

/// The part of a polygon with keep(p) >= 0, where keep is affine.
template <typename Keep>
std::vector<Vec2> cut(const std::vector<Vec2>& polygon, const Keep& keep) {
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const float at_a = keep(a), at_b = keep(b);
    if (at_a >= 0) {
      kept.push_back(a);
    }
    if ((at_a >= 0) != (at_b >= 0)) {
      kept.push_back(a + (b - a) * (at_a / (at_a - at_b)));
    }
  }
  return kept;
}

double area_inside(const Vec2& a, const Vec2& b, const Vec2& c) {
  std::vector<Vec2> polygon{a, b, c};
  polygon = cut(polygon, [](const Vec2& p) { return p.x; });
  polygon = cut(polygon, [](const Vec2& p) { return 1 - p.x; });
  polygon = cut(polygon, [](const Vec2& p) { return p.y; });
  polygon = cut(polygon, [](const Vec2& p) { return 1 - p.y; });
  double area = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    area += 0.5 * cross(polygon[0], polygon[i - 1], polygon[i]);
  }
  return std::abs(area);
}

/// Texel areas of a triangle that lie outside the picture.
double outside_area(const std::vector<Vec2>& corner_uv, std::size_t triangle, double uv_area) {
  const Vec2* uv = &corner_uv[3 * triangle];
  if (!outside(uv[0]) && !outside(uv[1]) && !outside(uv[2])) {
    return 0;
  }
  return std::max(0.0, std::abs(uv_area) - area_inside(uv[0], uv[1], uv[2]));
}

/// Charts join where triangles share a vertex and its UV.
void count_charts(const Mesh& mesh, const std::vector<std::uint32_t>& triangles,
                  const std::vector<Vec2>& corner_uv, const std::vector<TriangleAreas>& areas,
                  UvReport& report) {
  const std::vector<std::uint32_t> place = weld<3>(corner_uv.size(), [&](std::size_t corner) {
    const std::size_t of_mesh = 3 * std::size_t(triangles[corner / 3]) + corner % 3;
    return std::array{mesh.corner_vertex(of_mesh), weld_bits(corner_uv[corner].x),
                      weld_bits(corner_uv[corner].y)};
  });
  DisjointSets places(corner_uv.size());
  for (std::size_t first = 0; first < place.size(); first += 3) {
    places.join(place[first], place[first + 1]);
    places.join(place[first], place[first + 2]);
  }
  std::vector<double> signed_area(corner_uv.size());
  std::vector<bool> is_chart(corner_uv.size());
  for (std::size_t triangle = 0; triangle < areas.size(); ++triangle) {
    const std::uint32_t chart = places.find(place[3 * triangle]);
    is_chart[chart] = true;
    signed_area[chart] += areas[triangle].uv;
  }
  for (std::size_t chart = 0; chart < is_chart.size(); ++chart) {
    report.charts += is_chart[chart] ? 1 : 0;
    report.mirrored_charts += signed_area[chart] < 0 ? 1 : 0;
  }
}

/// A triangle on the back of another is a leaf's other side and not counted.
void count_doubled(const Mesh& mesh, const std::vector<std::uint32_t>& triangles,
                   const std::vector<TriangleAreas>& areas, UvReport& report) {
  std::vector<std::size_t> solid;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (!areas[i].flat_world) solid.push_back(3 * std::size_t(triangles[i]));
  const std::vector<std::uint32_t> place = weld<3>(3 * solid.size(), [&](std::size_t corner) {
    const Vec3& p = mesh.positions[mesh.corner_vertex(solid[corner / 3] + corner % 3)];
    return std::array{weld_bits(p.x), weld_bits(p.y), weld_bits(p.z)};
  });
  const std::vector<std::uint32_t> number = weld<3>(solid.size(), [&](std::size_t i) {
    std::array corners{place[3 * i], place[3 * i + 1], place[3 * i + 2]};
    std::ranges::rotate(corners, std::ranges::min_element(corners));  // whichever of them is the first
    return corners;
  });
  const std::size_t different = number.empty() ? 0 : *std::ranges::max_element(number) + std::size_t{1};
  report.doubled = solid.size() - different;
}

TexelDensity density_of(const std::vector<TriangleAreas>& areas, double texels) {
  std::vector<std::pair<double, double>> densities;  // density, world area
  double total = 0;
  for (const TriangleAreas& area : areas) {
    if (!area.flat_uv && !area.flat_world) {
      densities.emplace_back(std::sqrt(std::abs(area.uv) * texels / area.world), area.world);
      total += area.world;
    }
  }
  if (densities.empty()) {
    return {};
  }
  std::sort(densities.begin(), densities.end());
  double below = 0;
  const auto median = std::find_if(densities.begin(), densities.end(), [&](const auto& density) {
    below += density.second;
    return below >= 0.5 * total;
  });
  return {densities.front().first, (median == densities.end() ? densities.back() : *median).first,
          densities.back().first};
}

void count_triangles(const std::vector<TriangleAreas>& areas, UvReport& report) {
  for (const TriangleAreas& area : areas) {
    report.uv_area += std::abs(area.uv);
    report.world_area += area.world;
    report.degenerate_world += area.flat_world ? 1 : 0;
    report.degenerate_uv += area.flat_uv && !area.flat_world ? 1 : 0;
  }
}

void count_texels(const std::vector<Vec2>& corner_uv, int width, int height, UvReport& report) {
  for (const std::uint16_t layers : rasterize(corner_uv, width, height).layers) {
    report.covered_texels += layers > 0 ? 1 : 0;
    report.overlap_texels += layers > 1 ? 1 : 0;
  }
}

}  // namespace

UvReport report_uv(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, const std::vector<Vec2>& uv,
                   const Mat44& to_world, int width, int height) {
  std::vector<Vec2> corner_uv;
  corner_uv.reserve(3 * triangles.size());
  for (const std::uint32_t triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      corner_uv.push_back(uv[mesh.triangle_loops[3 * std::size_t(triangle) + k]]);
    }
  }
  const double texels = static_cast<double>(width) * height;
  UvReport report;
  report.triangles = triangles.size();
  std::vector<TriangleAreas> areas;
  areas.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    areas.push_back(areas_of(mesh, triangles[i], &corner_uv[3 * i], to_world));
    report.outside_texels += texels * outside_area(corner_uv, i, areas.back().uv);
    if (in_another_tile(&corner_uv[3 * i])) ++report.tile_triangles;
  }
  report.outside_corners =
      static_cast<std::size_t>(std::count_if(corner_uv.begin(), corner_uv.end(), outside));
  report.all_zero = !corner_uv.empty() && std::all_of(corner_uv.begin(), corner_uv.end(),
                                                      [&](const Vec2& p) { return p == corner_uv.front(); });
  count_triangles(areas, report);
  count_doubled(mesh, triangles, areas, report);
  count_texels(corner_uv, width, height, report);
  count_charts(mesh, triangles, corner_uv, areas, report);
  report.density = density_of(areas, texels);
  return report;
}

UvReport report_uv(const Mesh& mesh, const std::vector<Vec2>& uv, const Mat44& to_world, int width,
                   int height) {
  std::vector<std::uint32_t> all(mesh.triangles());
  std::iota(all.begin(), all.end(), std::uint32_t{0});
  return report_uv(mesh, all, uv, to_world, width, height);
}

}  // namespace rnmbake
