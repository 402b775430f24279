// encoding/zh3.h - SH-2 with a zonal lobe of band 2 that its length suggests.
#pragma once

#include "encoding/lobe.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {

/// E/pi = a + v.n + sqrt5/8 a rho (0.08 + 0.6 rho) (3 (v/|v| . n)^2 - 1), rho = min(sqrt3, sqrt3/2 |v|/a).
/// Roughton, Sloan, Silvennoinen, Iwanicki and Shirley, "ZH3: Quadratic Zonal Harmonics" (i3D 2024), section
/// on hallucinating the zonal lobe. Linear where a is not above 0 and, with its limits, where v is 0.
[[nodiscard]] LobeValue zh3_lobe(double a, const Vec3d& v, const Vec3d& normal);

/// A parabola in the cosine, whose vertex may lie within.
[[nodiscard]] inline double zh3_least(double a, double length, double least_cosine) {
  if (!(a > 0) || !(length > 0)) return a + length * least_cosine;
  constexpr double scale = 0.27950849718747373, greatest = 1.7320508075688772;
  const double rho = std::min(greatest, greatest / 2 * length / a),
               zonal = scale * a * rho * (0.08 + 0.6 * rho);
  const double cosine = std::max(least_cosine, -length / (6 * zonal));
  return a + length * cosine + zonal * (3 * cosine * cosine - 1);
}

[[nodiscard]] inline float zh3_decode(float a, const Vec3& v, const Vec3& normal) {
  return static_cast<float>(zh3_lobe(a, Vec3d(v), Vec3d(normal)).value);
}

}  // namespace rnmbake
