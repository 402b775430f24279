// encoding/refit/refit.h - the four numbers with which a decoder returns what was baked.
#pragma once

#include "encoding/lobe.h"
#include "encoding/refit/flat_kept.h"

#include <array>
#include <span>

namespace rnmbake {

/// Flat, rnm0, rnm1, rnm2.
[[nodiscard]] const std::array<Vec3d, 4>& four_directions();

/// The linear interpolation of the four bakes (encoding/linear_light.h), in double precision.
[[nodiscard]] FourNumbers linear_numbers(const FourBakes& bakes);

/// Solves lobe(a, v, direction i) = bake i: four equations, four unknowns, by Newton's steps from the linear
/// interpolation, or damped Gauss-Newton ones where those do not arrive. Where they do not arrive, the least
/// squares that were seen. a is above 0. Always finite; 0 for bakes of 0.
[[nodiscard]] FourNumbers nearest_numbers(Lobe lobe, const FourBakes& bakes);

/// The same, but where the steps do not arrive the numbers of flat_kept() within |v_i| <= 2a, if the flat
/// bake is above 0. Feeding a lobe that is not linear with the interpolation itself errs by much: that fits a
/// hemisphere, where these decoders expect the harmonics of the light.
[[nodiscard]] FourNumbers refit(Lobe lobe, const FourBakes& bakes);

/// The same of many, of which the first Newton's steps are taken side by side.
void refit(Lobe lobe, std::span<const FourBakes> bakes, std::span<FourNumbers> numbers);

}  // namespace rnmbake
