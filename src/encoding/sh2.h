// encoding/sh2.h - spherical harmonics of order 2 (bands 0 and 1) as a and v: linear in the normal.
#pragma once

#include "encoding/lobe.h"

namespace rnmbake {

/// E/pi = a + v . n. Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance Environment Maps"
/// (2001), bands 0 and 1. Of true harmonics a is the mean radiance over all directions and v the integral of
/// L(D) D over 2 pi; then |v| <= 2a.
[[nodiscard]] inline LobeValue sh2_lobe(double a, const Vec3d& v, const Vec3d& normal) {
  return {a + v.dot(normal), 1, normal};
}

[[nodiscard]] inline double sh2_least(double a, double length, double least_cosine) {
  return a + length * least_cosine;
}

[[nodiscard]] inline float sh2_decode(float a, const Vec3& v, const Vec3& normal) {
  return a + v.dot(normal);
}

}  // namespace rnmbake
