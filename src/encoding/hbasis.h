// encoding/hbasis.h - polynomials that are orthonormal over the upper hemisphere.
#pragma once

#include "base/math.h"

#include <array>
#include <cmath>

namespace rnmbake {

/// h0 to h5 at a unit normal in tangent space; the first four are the basis H4. E/pi is their sum, weighed by
/// the coefficients. Habel and Wimmer, "Efficient Irradiance Normal Mapping" (I3D 2010).
[[nodiscard]] inline std::array<double, 6> h_basis(const Vec3d& n) {
  static const double h0 = std::sqrt(1 / (2 * pi)), linear = std::sqrt(3 / (2 * pi)),
                      square = std::sqrt(15 / (2 * pi));
  return {h0,           linear * n.y,       linear * (2 * n.z - 1),
          linear * n.x, square * n.x * n.y, square * (n.x * n.x - n.y * n.y) / 2};
}

}  // namespace rnmbake
