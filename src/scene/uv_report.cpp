#include "scene/uv_report.h"

#include "scene/disjoint_sets.h"
#include "scene/uv_raster.h"
#include "scene/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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

/// Area against the longest edge: below this a triangle is a line as far as floats can tell.
bool is_flat(double area, double longest2) {
  return area <= 1e-7 * longest2;
}

TriangleAreas areas_of(const Mesh& mesh, const std::vector<Vec2>& corner_uv, const Mat44& to_world,
                       std::size_t triangle) {
  const std::size_t first = 3 * triangle;
  const auto at = [&](std::size_t i) { return Vec3d(mesh.positions[mesh.corner_vertex(first + i)]); };
  Vec3d ab, ac;
  to_world.multDirMatrix(at(1) - at(0), ab);
  to_world.multDirMatrix(at(2) - at(0), ac);
  TriangleAreas areas;
  areas.world = 0.5 * ab.cross(ac).length();
  areas.flat_world = is_flat(areas.world, std::max({ab.length2(), ac.length2(), (ab - ac).length2()}));
  const Vec2 &a = corner_uv[first], &b = corner_uv[first + 1], &c = corner_uv[first + 2];
  areas.uv = 0.5 * cross(a, b, c);
  const double longest2 = std::max({(b - a).length2(), (c - a).length2(), (c - b).length2()});
  areas.flat_uv = is_flat(std::abs(areas.uv), longest2);
  return areas;
}

bool outside(const Vec2& uv) {
  return uv.x < -border_slack || uv.y < -border_slack || uv.x > 1 + border_slack || uv.y > 1 + border_slack;
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
void count_charts(const Mesh& mesh, const std::vector<Vec2>& corner_uv,
                  const std::vector<TriangleAreas>& areas, UvReport& report) {
  const std::vector<std::uint32_t> place = weld<3>(corner_uv.size(), [&](std::size_t corner) {
    return std::array{mesh.corner_vertex(corner), weld_bits(corner_uv[corner].x),
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

UvReport report_uv(const Mesh& mesh, const std::vector<Vec2>& uv, const Mat44& to_world, int width,
                   int height) {
  std::vector<Vec2> corner_uv;
  corner_uv.reserve(mesh.triangle_loops.size());
  for (const std::uint32_t loop : mesh.triangle_loops) {
    corner_uv.push_back(uv[loop]);
  }
  const double texels = static_cast<double>(width) * height;
  UvReport report;
  report.triangles = mesh.triangles();
  std::vector<TriangleAreas> areas;
  for (std::size_t triangle = 0; triangle < mesh.triangles(); ++triangle) {
    areas.push_back(areas_of(mesh, corner_uv, to_world, triangle));
    report.outside_texels += texels * outside_area(corner_uv, triangle, areas.back().uv);
  }
  report.outside_corners =
      static_cast<std::size_t>(std::count_if(corner_uv.begin(), corner_uv.end(), outside));
  report.all_zero = !corner_uv.empty() && std::all_of(corner_uv.begin(), corner_uv.end(),
                                                      [&](const Vec2& p) { return p == corner_uv.front(); });
  count_triangles(areas, report);
  count_texels(corner_uv, width, height, report);
  count_charts(mesh, corner_uv, areas, report);
  report.density = density_of(areas, texels);
  return report;
}

}  // namespace rnmbake
