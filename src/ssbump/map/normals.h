// ssbump/map/normals.h - normals from heights, and to and from weights.
#pragma once

#include "image/float_image.h"
#include "ssbump/heights/height_field.h"

namespace rnmbake {

/// Rows [begin, end) of the surface's unit normals, y up: central differences, which is the mean of the four
/// patches that meet in the texel's centre.
[[nodiscard]] FloatImage height_normals(const HeightField& field, int begin, int end);

/// normalise(sum of w_i B_i), y up: where most of the open sky is. (0, 0, 1) where all weights are 0.
/// Takes three channels or more.
[[nodiscard]] FloatImage bent_normals(const FloatImage& weights);

/// Weights (SsbumpWeights, five channels) out of a normal map alone: sat(N . B_i) over that of a flat normal,
/// so up to sqrt 3; straight up is sat(N_z), ambient 1, as nothing is in the light's way. `normals`: unit
/// length, y up.
[[nodiscard]] FloatImage weights_of_normals(const FloatImage& normals);

/// Unit vectors to what a normal map stores, (n + 1) / 2 with y up or down.
void pack_normals(FloatImage& normals, bool y_down);

}  // namespace rnmbake
