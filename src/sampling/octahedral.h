// sampling/octahedral.h - the sphere of directions unfolded into a square.
#pragma once

#include "base/math.h"

#include <cmath>

namespace rnmbake {

/// Of a unit direction, in [-1, 1]^2: +z in the middle, -z at the four corners. Cigolle et al., "A Survey of
/// Efficient Representations for Independent Unit Vectors" (JCGT 2014).
[[nodiscard]] inline Vec2 octahedral(const Vec3& d) {
  const float scale = 1 / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
  const Vec2 p(d.x * scale, d.y * scale);
  if (d.z >= 0) return p;
  return {std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y)};
}

/// The inverse; unit.
[[nodiscard]] inline Vec3 octahedral_direction(const Vec2& p) {
  const float z = 1 - std::abs(p.x) - std::abs(p.y);
  if (z >= 0) return unit(Vec3(p.x, p.y, z));
  return unit(Vec3(std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y), z));
}

}  // namespace rnmbake
