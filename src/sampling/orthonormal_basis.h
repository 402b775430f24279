// sampling/orthonormal_basis.h - a coordinate frame around a direction.
#pragma once

#include "base/math.h"

#include <cmath>

namespace rnmbake {

/// Right-handed, around a unit `z`. Duff et al., "Building an Orthonormal Basis, Revisited" (JCGT 2017).
struct OrthonormalBasis {
  Vec3 x, y, z;
  explicit OrthonormalBasis(const Vec3& axis) : z(axis) {
    const float sign = std::copysign(1.0F, z.z), a = -1 / (sign + z.z), b = z.x * z.y * a;
    x = Vec3(1 + sign * z.x * z.x * a, sign * b, -sign * z.x);
    y = Vec3(b, sign + z.y * z.y * a, -z.y);
  }
  [[nodiscard]] Vec3 to_world(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
};

}  // namespace rnmbake
