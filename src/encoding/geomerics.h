// encoding/geomerics.h - SH-2 decoded as a power of the half cosine, which is never negative for real light.
#pragma once

#include "encoding/lobe.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {

/// E/pi = a (A + (1 - A) (p + 1) q^p), q = (1 + v/|v| . n) / 2, r = |v| / 2a, p = 1 + 2r, A = (1 - r)/(1 +
/// r): = a A + 2 |v| q^p. Hazel, "Reconstructing Diffuse Lighting from Spherical Harmonic Data" (Geomerics,
/// 2015); unclamped, as engines have it. The constant a where a is not above 0.
[[nodiscard]] inline LobeValue geomerics_lobe(double a, const Vec3d& v, const Vec3d& normal) {
  const double length = v.length();
  if (!(a > 0) || !(length > 0)) return {a, 1, a > 0 ? normal : Vec3d(0)};
  const Vec3d axis = v / length;
  const double r = length / (2 * a), p = 1 + 2 * r, ambient = (1 - r) / (1 + r);
  const double cosine = std::clamp(axis.dot(normal), -1.0, 1.0), q = (1 + cosine) / 2;
  const double log_q = q > 0 ? std::log(q) : 0;  // q^p log q goes to 0
  const double power = q > 0 ? std::exp(p * log_q) : 0, slope = q > 0 ? p * power / q : 0,
               by_p = power * log_q;
  const double by_r = 2 / ((1 + r) * (1 + r));  // -dA/dr
  return {a * ambient + 2 * length * power, ambient + by_r * r - 8 * r * r * by_p,
          axis * (2 * power + 4 * r * by_p - by_r / 2) + (normal - axis * cosine) * slope};
}

[[nodiscard]] inline float geomerics_decode(float a, const Vec3& v, const Vec3& normal) {
  return static_cast<float>(geomerics_lobe(a, Vec3d(v), Vec3d(normal)).value);
}

}  // namespace rnmbake
