// encoding/ahd.h - an ambient and a highlight colour, and the one direction that the highlight comes from.
#pragma once

#include "encoding/lobe.h"

#include <algorithm>

namespace rnmbake {

/// E/pi = ambient + directional sat(direction . n), `direction` a unit vector. Iwanicki, "Lighting Technology
/// of The Last of Us" (SIGGRAPH 2013).
[[nodiscard]] inline Vec3 ahd_decode(const Vec3& ambient, const Vec3& directional, const Vec3& direction,
                                     const Vec3& normal) {
  return ambient + directional * std::max(0.0F, direction.dot(normal));
}

/// One colour of it as a lobe of a = ambient and v = directional direction.
[[nodiscard]] inline LobeValue ahd_lobe(double a, const Vec3d& v, const Vec3d& normal) {
  const double light = v.dot(normal);
  return {a + std::max(0.0, light), 1, light > 0 ? normal : Vec3d(0)};
}

}  // namespace rnmbake
