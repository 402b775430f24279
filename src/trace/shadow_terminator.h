// trace/shadow_terminator.h - how far the curved surface that a smooth triangle stands for rises off the flat
// one.
//
// Cycles' "shadow terminator geometry offset", 0.1 unless an object says otherwise, lets rays to lights start
// up there where they leave at a grazing angle or, as the recipe lets them, under the face. The latter may
// then meet the triangle itself: what bulges enough lets the light by, what is hollow does not.
#pragma once

#include "base/math.h"

#include <array>

namespace rnmbake {

struct SmoothTriangle {
  std::array<Vec3, 3> positions;
  std::array<Vec3, 3> normals;  // of the shading, unit
};

/// From the flat triangle to the curved surface, along the interpolated normal; `weights`: barycentric.
[[nodiscard]] Vec3 terminator_offset(const SmoothTriangle& triangle, const Vec3& weights);

}  // namespace rnmbake
