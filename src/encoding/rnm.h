// encoding/rnm.h - the Half-Life 2 basis (radiosity normal mapping) and the ways the field decodes it.
#pragma once

#include "base/math.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace rnmbake {

/// The three directions in tangent space (x = tangent, y = bitangent, z = normal): orthonormal, each 54.7
/// degrees off the normal. McTaggart, "Half-Life 2 / Valve Source Shading" (GDC 2004).
[[nodiscard]] inline std::array<Vec3, 3> rnm_basis() {
  const auto vec = [](double x, double y, double z) { return Vec3(Vec3d(x, y, z)); };
  const double s2 = std::sqrt(1.0 / 2), s3 = std::sqrt(1.0 / 3), s6 = std::sqrt(1.0 / 6);
  return {vec(2 * s6, 0, s3), vec(-s6, s2, s3), vec(-s6, -s2, s3)};
}

/// sat(dot(normal, B_i)): the weights of the linear decode. They do not sum to 1.
[[nodiscard]] inline std::array<float, 3> rnm_linear_weights(const Vec3& normal) {
  const auto basis = rnm_basis();
  std::array<float, 3> weights{};
  for (std::size_t i = 0; i < 3; ++i) weights[i] = std::max(0.0F, normal.dot(basis[i]));
  return weights;
}

/// sat(dot(normal, B_i))^2, renormalised to sum to 1. The squares sum to 1 by themselves for a unit normal
/// until the clamp bites, at a tilt of 35.3 degrees. All zero for a normal that lies under the surface of all
/// three.
[[nodiscard]] inline std::array<float, 3> rnm_squared_weights(const Vec3& normal) {
  auto weights = rnm_linear_weights(normal);
  float sum = 0;
  for (float& weight : weights) sum += weight *= weight;
  if (sum > 0)
    for (float& weight : weights) weight /= sum;
  return weights;
}

/// Weighted sum of three maps' values; Colour is anything with + and * float.
template <typename Colour>
[[nodiscard]] Colour rnm_weighted(const std::array<Colour, 3>& maps, const std::array<float, 3>& weights) {
  return maps[0] * weights[0] + maps[1] * weights[1] + maps[2] * weights[2];
}

/// Source's decode, corrected: sum w LM / sum w with squared weights. On maps that keep the integral's
/// definition a flat normal under a uniform sky of 1 returns (1 + 1/sqrt 3) / 2 = 0.789, on maps scaled by
/// rnm_scaled_to_flat() it returns the flat bake.
template <typename Colour>
[[nodiscard]] Colour rnm_decode_squared(const std::array<Colour, 3>& maps, const Vec3& normal) {
  return rnm_weighted(maps, rnm_squared_weights(normal));
}

/// Bakery's and many engines' decode: sum sat(dot) LM, not renormalised.
template <typename Colour>
[[nodiscard]] Colour rnm_decode_linear(const std::array<Colour, 3>& maps, const Vec3& normal) {
  return rnm_weighted(maps, rnm_linear_weights(normal));
}

/// One colour channel of the three maps, scaled so that their mean is `flat` (as vrad does it). Three zeros
/// cannot be scaled and become `flat` each, so that a flat normal decodes to the flat bake everywhere.
[[nodiscard]] inline std::array<float, 3> rnm_scaled_to_flat(const std::array<float, 3>& maps, float flat) {
  const double sum = static_cast<double>(maps[0]) + maps[1] + maps[2];
  if (!(sum > 0)) return {flat, flat, flat};
  const auto scaled = [&](float map) { return static_cast<float>(map / sum * 3 * flat); };
  return {scaled(maps[0]), scaled(maps[1]), scaled(maps[2])};
}

}  // namespace rnmbake
