// encoding/linear_light.h - irradiance linear in the normal, which the four bakes of flat and the Half-Life 2
// basis determine.
#pragma once

#include "base/math.h"
#include "encoding/rnm.h"

#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

namespace rnmbake {

/// a and v of E/pi = a + v . n through the four bakes of one colour; `basis`: rnm_basis().
template <typename Number>
[[nodiscard]] std::pair<Number, Imath::Vec3<Number>> linear_through(
    Number flat, const std::array<Number, 3>& rnm, const std::array<Imath::Vec3<Number>, 3>& basis) {
  const auto sum = basis[0] * rnm[0] + basis[1] * rnm[1] + basis[2] * rnm[2];
  const Number mean = (rnm[0] + rnm[1] + rnm[2]) / 3;
  const Number up = (flat - mean) / (1 - basis[0].z);
  return {flat - up, {sum.x, sum.y, up}};
}

/// Irradiance linear in the normal (SH bands 0 and 1): E(n)/pi = ambient + gradient . n, for each of R, G, B.
struct LinearLight {
  std::array<float, 3> ambient{};
  std::array<Vec3, 3> gradient{Vec3(0), Vec3(0), Vec3(0)};

  [[nodiscard]] float at(std::size_t colour, const Vec3& n) const {
    return ambient[colour] + gradient[colour].dot(n);
  }
};

/// Interpolates the four baked values at (0, 0, 1) and at the three directions of the Half-Life 2 basis,
/// which determine such a function. A lone sun above the horizon of all three gives ambient 0, gradient
/// towards it.
[[nodiscard]] inline LinearLight fit_linear(const std::array<float, 3>& flat,
                                            const std::array<std::array<float, 3>, 3>& rnm) {
  const auto basis = rnm_basis();
  LinearLight light;
  for (std::size_t c = 0; c < 3; ++c) {
    std::tie(light.ambient[c], light.gradient[c]) =
        linear_through(flat[c], std::array{rnm[0][c], rnm[1][c], rnm[2][c]}, basis);
  }
  return light;
}

}  // namespace rnmbake
