// encoding/sh.h - real spherical harmonics of the first three orders.
#pragma once

#include "base/math.h"

#include <array>
#include <cstddef>

namespace rnmbake {

/// Y(l, m) at a unit direction in the order (0,0), (1,-1), (1,0), (1,1), (2,-2) .. (2,2); orthonormal over
/// the sphere, signs without the Condon-Shortley phase: Y(1, .) ~ y, z, x. Ramamoorthi and Hanrahan, "An
/// Efficient Representation for Irradiance Environment Maps" (2001).
[[nodiscard]] inline std::array<float, 9> sh_basis(const Vec3& d) {
  constexpr float y0 = 0.28209479F, y1 = 0.48860251F, y2 = 1.09254843F, y20 = 0.31539157F;
  return {y0,
          y1 * d.y,
          y1 * d.z,
          y1 * d.x,
          y2 * d.x * d.y,
          y2 * d.y * d.z,
          y20 * (3 * d.z * d.z - 1),
          y2 * d.x * d.z,
          0.5F * y2 * (d.x * d.x - d.y * d.y)};
}

/// Zonal coefficients A(l) of the clamped cosine over pi, which turn coefficients c of radiance into
/// irradiance: E/pi = sum of A(l) c(l, m) Y(l, m).
inline constexpr std::array<float, 3> sh_cosine_over_pi{1.0F, 2.0F / 3, 1.0F / 4};

/// A(l) Y(l, m) of a unit normal: what coefficients of radiance are multiplied with to give E/pi.
[[nodiscard]] inline std::array<float, 9> sh_irradiance_basis(const Vec3& normal) {
  std::array<float, 9> values = sh_basis(normal);
  for (std::size_t i = 0; i < 9; ++i) values[i] *= sh_cosine_over_pi[i == 0 ? 0 : i < 4 ? 1 : 2];
  return values;
}

}  // namespace rnmbake
