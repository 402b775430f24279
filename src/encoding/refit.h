// encoding/refit.h - the four numbers with which a decoder returns what was baked.
#pragma once

#include "encoding/lobe.h"

#include <array>

namespace rnmbake {

/// Flat, rnm0, rnm1, rnm2, in this order: of one colour, E/pi; or the directions themselves.
using FourBakes = std::array<double, 4>;
[[nodiscard]] const std::array<Vec3d, 4>& four_directions();

struct FourNumbers {
  double a = 0;
  Vec3d v = Vec3d(0);
  bool has_converged = true;  // the lobe returns each bake within 1e-6 of the greatest
};

/// The linear interpolation of the four bakes (encoding/linear_light.h), in double precision.
[[nodiscard]] FourNumbers linear_numbers(const FourBakes& bakes);

/// Solves lobe(a, v, direction i) = bake i: four equations, four unknowns, by damped Gauss-Newton steps from
/// the linear interpolation. Feeding that interpolation itself to a lobe that is not linear errs by much: it
/// fits a hemisphere, where these decoders expect the harmonics of the light. Where the steps do not arrive,
/// the best numbers seen, with a above 0. Always finite; 0 for bakes of 0.
[[nodiscard]] FourNumbers refit(Lobe lobe, const FourBakes& bakes);

}  // namespace rnmbake
