// scene/flat_triangle.h - which triangles have an area.
#pragma once

#include "base/math.h"
#include "scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rnmbake {

/// Area against the square of the longest edge: below this a triangle is a line as far as floats can tell.
inline bool is_flat(double area, double longest2) {
  return !(area > 1e-7 * longest2) || !std::isfinite(area);
}

struct TriangleShape {
  Vec3d normal{0, 0, 0};  // twice as long as the triangle is large
  double area = 0;        // square world units
  double longest2 = 0;
  bool on_a_line = false;  // but for the rounding of its positions
  [[nodiscard]] bool flat() const { return on_a_line || is_flat(area, longest2); }
};

/// Whether three places differ from some on a line by no more than floats are rounded by. Half a spacing of
/// the largest coordinate, at most 2^-24 of it, moves a corner that far off the line; two such moves along
/// the longest edge make the area.
inline bool rounded_line(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  double reach = 0;
  for (const Vec3d& p : {a, b, c}) reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const double longest = std::sqrt(std::max({(b - a).length2(), (c - a).length2(), (c - b).length2()}));
  return 0.5 * (b - a).cross(c - a).length() <= 0x1p-23 * reach * longest;
}

inline TriangleShape triangle_shape(const Mesh& mesh, std::size_t triangle, const Mat44& to_world) {
  const auto at = [&](std::size_t i) { return Vec3d(mesh.positions[mesh.corner_vertex(3 * triangle + i)]); };
  const Vec3d a = at(0), b = at(1), c = at(2);
  Vec3d ab, ac;
  to_world.multDirMatrix(b - a, ab);
  to_world.multDirMatrix(c - a, ac);
  const Vec3d normal = ab.cross(ac);
  const double longest2 = std::max({ab.length2(), ac.length2(), (ab - ac).length2()});
  return {normal, 0.5 * normal.length(), longest2, rounded_line(a, b, c)};
}

}  // namespace rnmbake
