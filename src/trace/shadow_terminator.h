// trace/shadow_terminator.h - offset from a smooth-shaded triangle to the curved surface that it
// approximates.
//
// With Cycles' "shadow terminator geometry offset", 0.1 unless an object says otherwise, shadow rays start on
// the curved surface where they leave at a grazing angle or, with the recipe, below the face. The latter may
// then hit the triangle itself: a convex surface can let the light pass, a concave one occludes it.
#pragma once

#include "base/math.h"

#include <array>

namespace rnmbake {

struct SmoothTriangle {
  std::array<Vec3, 3> positions;
  std::array<Vec3, 3> normals;  // of the shading, unit
};

/// Offset along the interpolated normal; `weights`: barycentric coordinates.
[[nodiscard]] Vec3 terminator_offset(const SmoothTriangle& triangle, const Vec3& weights);

}  // namespace rnmbake
