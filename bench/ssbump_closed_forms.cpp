#include "ssbump_closed_forms.h"

#include "base/math.h"
#include "ssbump/map/lobes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace rnmbake {
namespace {

constexpr int side_length = 256, centre = side_length / 2;

/// Length of the arc of the great circle across `normal` on which all other half-spaces are open. Each
/// half-space leaves half of the circle, so their intersection is one arc.
double arc_within(const Vec3d& normal, const std::vector<Vec3d>& planes) {
  const Vec3d aside = std::abs(normal.z) < 0.9 ? Vec3d(0, 0, 1) : Vec3d(1, 0, 0);
  const Vec3d u = normal.cross(aside).normalized(), v = normal.cross(u);
  double before = HUGE_VAL, after = HUGE_VAL, middle = 0;  // of the first's middle
  bool first = true;
  for (const Vec3d& plane : planes) {
    const double along_u = plane.dot(u), along_v = plane.dot(v);
    if (std::hypot(along_u, along_v) < 1e-12) continue;  // the same plane
    const double azimuth = std::atan2(along_v, along_u);
    if (first) middle = azimuth;
    first = false;
    const double turn = std::remainder(azimuth - middle, 2 * pi);
    before = std::min(before, pi / 2 - turn);
    after = std::min(after, pi / 2 + turn);
  }
  return first ? 2 * pi : std::max(0.0, before + after);
}

/// Light along `axis` out of all directions that lie in every half-space (unit normals, pointing inwards):
/// Lambert's formula for a polygon's irradiance, half the sum over its edges of angle times normal . axis.
double light_within(std::vector<Vec3d> planes, const Vec3d& axis) {
  planes.push_back(axis);
  std::vector<Vec3d> distinct;
  for (const Vec3d& plane : planes) {
    if (std::ranges::none_of(distinct, [&](const Vec3d& one) { return one.dot(plane) > 1 - 1e-14; }))
      distinct.push_back(plane);
  }
  double sum = 0;
  for (const Vec3d& plane : distinct) sum += arc_within(plane, distinct) * plane.dot(axis) / 2;
  return sum;
}

/// The sky over planes z = slope.x x + slope.y y that rise from a texel.
Channels weights_over(const std::vector<Imath::V2d>& slopes) {
  std::vector<Vec3d> planes{{0, 0, 1}};
  for (const Imath::V2d& slope : slopes) planes.push_back(Vec3d(-slope.x, -slope.y, 1).normalized());
  const auto lobes = ssbump_lobes(1);
  Channels weights;
  for (std::size_t c = 0; c < weights.size(); ++c) {
    const Vec3d axis = lobes[c].axis.normalized();
    weights[c] = light_within(planes, axis) / light_within({{0, 0, 1}}, axis);
  }
  return weights;
}

/// Heights by the distance from the middle.
template <typename Function>
HeightField surface(const Function& height) {
  return field_of(side_length, side_length, WrapMode::none,
                  [&](int x, int y) { return height(x - centre, y - centre); });
}

}  // namespace

std::vector<ClosedForm> closed_forms() {
  constexpr Texel middle{centre, centre};
  constexpr double wall = 16;
  std::vector<ClosedForm> forms;
  for (const double s : {0.25, 1.0, 4.0}) {
    forms.push_back({fmt::format("plane, slope {:g}", s), surface([&](int x, int) { return s * x; }), middle,
                     weights_over({{s, 0}})});
    forms.push_back({fmt::format("plane that rises up the picture, slope {:g}", s),
                     surface([&](int, int y) { return -s * y; }), middle, weights_over({{0, s}})});
    forms.push_back({fmt::format("bottom of a V-groove, slope {:g}", s),
                     surface([&](int x, int) { return s * std::abs(x); }), middle,
                     weights_over({{s, 0}, {-s, 0}})});
    forms.push_back({fmt::format("bottom of a funnel of four planes, slope {:g} across and down", s),
                     surface([&](int x, int y) { return s * (std::abs(x) + std::abs(y)); }), middle,
                     weights_over({{s, s}, {s, -s}, {-s, s}, {-s, -s}})});
  }
  const HeightField step = surface([&](int x, int) { return x < 0 ? 0 : wall; });
  for (const int distance : {1, 2, 4, 16, 64})
    forms.push_back({fmt::format("{} before a step of 16", distance),
                     step,
                     {centre - distance, centre},
                     weights_over({{wall / distance, 0}})});
  forms.push_back({"edge of a step of 16", step, middle, weights_over({})});
  forms.push_back({"top of a hemisphere, radius 64", surface([](int x, int y) {
                     return std::sqrt(std::max(0.0, 64.0 * 64 - double(x) * x - double(y) * y));
                   }),
                   middle, weights_over({})});
  return forms;
}

}  // namespace rnmbake
