// encoding/unity_dominant.h - a colour and one dominant direction, as Unity's directional lightmaps have
// them.
#pragma once

#include "base/math.h"

#include <algorithm>

namespace rnmbake {

/// E/pi = colour (n . (direction - 1/2) + 1/2) / max(1e-4, directionality): `direction` is d/2 + 1/2 with
/// |d| <= 1, `directionality` (d . N + 1) / 2 for the surface's own normal N, which returns `colour`. The
/// decoder of Unity's built-in shaders (DecodeDirectionalLightmap).
[[nodiscard]] inline Vec3 dominant_decode(const Vec3& colour, const Vec3& direction, float directionality,
                                          const Vec3& normal) {
  const float half_lambert = normal.dot(direction - Vec3(0.5F)) + 0.5F;
  return colour * (half_lambert / std::max(1e-4F, directionality));
}

}  // namespace rnmbake
