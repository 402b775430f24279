// sampling/maps.h - maps from the unit square to disks, cones, hemispheres and triangles, each beside its
// density.
//
// `u` is uniform in [0,1)^2. Directions are unit vectors around +z, their densities per solid angle. Polar
// maps take a radius or a height from u.x and an angle from u.y; the concentric map of the disk keeps
// neighbours neighbours, so that stratified samples stay so.
#pragma once

#include "base/math.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rnmbake {

inline constexpr float pi_f = 3.14159265F, inv_pi = 1 / pi_f;
inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// Uniform in the unit disk by the concentric map (Shirley & Chiu 1997).
[[nodiscard]] inline Vec2 uniform_disk(const Vec2& u) {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::abs(a) > std::abs(b);
  const float radius = wide ? a : b;
  const float angle = wide ? pi_f / 4 * (b / a) : pi_f / 2 - pi_f / 4 * (a / b);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}
/// Per area.
inline constexpr float uniform_disk_pdf = inv_pi;

/// Uniform in the cone of directions with 1 - cosine <= `height`, by the concentric map. `height` 1: a
/// hemisphere, 2: the sphere. Exact for narrow cones, where a cosine is not.
[[nodiscard]] inline Vec3 uniform_cone(float height, const Vec2& u) {
  const Vec2 d = uniform_disk(u);
  const float drop = height * d.length2();  // 1 - cosine
  const float scale = std::sqrt(std::max(height * (2 - drop), 0.0F));
  return {d.x * scale, d.y * scale, 1 - drop};
}
[[nodiscard]] inline float uniform_cone_pdf(float height) {
  return 1 / (2 * pi_f * height);
}

/// Uniform over the hemisphere, by polar coordinates.
[[nodiscard]] inline Vec3 uniform_hemisphere_polar(const Vec2& u) {
  const float z = u.x, r = std::sqrt(std::max(0.0F, 1 - z * z)), phi = static_cast<float>(2 * pi) * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}
inline constexpr float uniform_hemisphere_pdf = 1 / (2 * pi_f);

/// Proportional to the cosine: a uniform point of the disk, lifted to the hemisphere (Malley's method).
[[nodiscard]] inline Vec3 cosine_hemisphere(const Vec2& u) {
  const Vec2 d = uniform_disk(u);
  return {d.x, d.y, std::sqrt(std::max(1 - d.length2(), 0.0F))};
}
/// The same density by polar coordinates.
[[nodiscard]] inline Vec3 cosine_hemisphere_polar(const Vec2& u) {
  const float r = std::sqrt(u.x), phi = static_cast<float>(2 * pi) * u.y;
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0F, 1 - u.x))};
}
/// Of both; `cosine` >= 0.
[[nodiscard]] inline float cosine_hemisphere_pdf(float cosine) {
  return cosine * inv_pi;
}

/// Uniform in a triangle: barycentric coordinates of its corners 1 and 2.
[[nodiscard]] inline Vec2 uniform_triangle(const Vec2& u) {
  const float root = std::sqrt(u.x);
  return {root * (1 - u.y), root * u.y};
}
/// Per area.
[[nodiscard]] inline float uniform_triangle_pdf(float area) {
  return 1 / area;
}

}  // namespace rnmbake
