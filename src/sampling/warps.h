// sampling/warps.h - random directions and places with known densities.
#pragma once

#include "base/math.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rnmbake {

inline constexpr float pi_f = 3.14159265F, inv_pi = 1 / pi_f;
inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// Right-handed axes around a unit `z`. Duff et al., "Building an Orthonormal Basis, Revisited" (JCGT 2017).
struct Axes {
  Vec3 x, y, z;
  explicit Axes(const Vec3& axis) : z(axis) {
    const float sign = std::copysign(1.0F, z.z), a = -1 / (sign + z.z), b = z.x * z.y * a;
    x = Vec3(1 + sign * z.x * z.x * a, sign * b, -sign * z.x);
    y = Vec3(b, sign + z.y * z.y * a, -z.y);
  }
  [[nodiscard]] Vec3 to_world(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
};

/// Uniform in the unit disk (Shirley & Chiu 1997).
[[nodiscard]] inline Vec2 disk_place(const Vec2& u) {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::abs(a) > std::abs(b);
  const float radius = wide ? a : b;
  const float angle = wide ? pi_f / 4 * (b / a) : pi_f / 2 - pi_f / 4 * (a / b);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Uniform per solid angle around +z between the axis and 1 - cosine = `height`; the density is
/// 1 / (2 pi height). `height` 1: a hemisphere, 2: the sphere. Exact for narrow cones, where a cosine is not.
[[nodiscard]] inline Vec3 cone_direction(float height, const Vec2& u) {
  const Vec2 d = disk_place(u);
  const float drop = height * d.length2();  // 1 - cosine
  const float scale = std::sqrt(std::max(height * (2 - drop), 0.0F));
  return {d.x * scale, d.y * scale, 1 - drop};
}
[[nodiscard]] inline float cone_density(float height) {
  return 1 / (2 * pi_f * height);
}

/// Around +z, the density is cosine / pi.
[[nodiscard]] inline Vec3 cosine_direction(const Vec2& u) {
  const Vec2 d = disk_place(u);
  return {d.x, d.y, std::sqrt(std::max(1 - d.length2(), 0.0F))};
}

}  // namespace rnmbake
