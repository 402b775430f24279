// encoding/geomerics.h - SH-2 decoded as a power of the half cosine, which is never negative for real light.
#pragma once

#include "encoding/lobe.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {

/// E/pi = a (A + (1 - A) (p + 1) q^p), q = (1 + v/|v| . n) / 2, r = |v| / 2a, p = 1 + 2r, A = (1 - r)/(1 +
/// r): = a A + 2 |v| q^p. Hazel, "Reconstructing Diffuse Lighting from Spherical Harmonic Data" (Geomerics,
/// 2015); unclamped, as engines have it. The constant a where a is not above 0.
[[nodiscard]] LobeValue geomerics_lobe(double a, const Vec3d& v, const Vec3d& normal);

/// What a A leaves above 0 needs no power.
[[nodiscard]] inline double geomerics_least(double a, double length, double least_cosine) {
  if (!(a > 0) || !(length > 0)) return a;
  const double r = length / (2 * a), constant = a * (1 - r) / (1 + r);
  return constant >= 0 ? constant : constant + 2 * length * std::pow((1 + least_cosine) / 2, 1 + 2 * r);
}

[[nodiscard]] inline float geomerics_decode(float a, const Vec3& v, const Vec3& normal) {
  return static_cast<float>(geomerics_lobe(a, Vec3d(v), Vec3d(normal)).value);
}

}  // namespace rnmbake
