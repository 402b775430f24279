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
  [[nodiscard]] bool flat() const { return is_flat(area, longest2); }
};

inline TriangleShape triangle_shape(const Mesh& mesh, std::size_t triangle, const Mat44& to_world) {
  const auto at = [&](std::size_t i) { return Vec3d(mesh.positions[mesh.corner_vertex(3 * triangle + i)]); };
  Vec3d ab, ac;
  to_world.multDirMatrix(at(1) - at(0), ab);
  to_world.multDirMatrix(at(2) - at(0), ac);
  const Vec3d normal = ab.cross(ac);
  return {normal, 0.5 * normal.length(), std::max({ab.length2(), ac.length2(), (ab - ac).length2()})};
}

}  // namespace rnmbake
