// encoding/zh3.h - SH-2 with a zonal lobe of band 2 that its length suggests.
#pragma once

#include "encoding/lobe.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {

/// E/pi = a + v.n + sqrt5/8 a rho (0.08 + 0.6 rho) (3 (v/|v| . n)^2 - 1), rho = min(sqrt3, sqrt3/2 |v|/a).
/// Roughton, Sloan, Silvennoinen, Iwanicki and Shirley, "ZH3: Quadratic Zonal Harmonics" (i3D 2024), section
/// on hallucinating the zonal lobe. Linear where a is not above 0 and, with its limits, where v is 0.
[[nodiscard]] inline LobeValue zh3_lobe(double a, const Vec3d& v, const Vec3d& normal) {
  const double length = v.length();
  LobeValue lobe{a + v.dot(normal), 1, normal};
  if (!(a > 0) || !(length > 0)) return lobe;
  constexpr double scale = 0.27950849718747373, greatest = 1.7320508075688772;  // sqrt5 / 8, sqrt3
  const bool is_bounded = length >= 2 * a;
  const double rho = is_bounded ? greatest : greatest / 2 * length / a;
  const Vec3d axis = v / length;
  const double cosine = axis.dot(normal), shape = 3 * cosine * cosine - 1;
  const double strength = rho * (0.08 + 0.6 * rho), slope = is_bounded ? 0 : 0.08 + 1.2 * rho;
  lobe.value += scale * a * strength * shape;
  lobe.by_a += scale * shape * (strength - slope * rho);
  lobe.by_v += axis * (scale * shape * slope * greatest / 2);
  lobe.by_v += (normal - axis * cosine) * (scale * a / length * strength * 6 * cosine);
  return lobe;
}

[[nodiscard]] inline float zh3_decode(float a, const Vec3& v, const Vec3& normal) {
  return static_cast<float>(zh3_lobe(a, Vec3d(v), Vec3d(normal)).value);
}

}  // namespace rnmbake
