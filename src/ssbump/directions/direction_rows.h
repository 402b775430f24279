// ssbump/directions/direction_rows.h - weights of a height field's texels for any set of directions, by rays.
#pragma once

#include "encoding/basis_set.h"
#include "encoding/fit/direction_weights.h"
#include "image/float_image.h"
#include "ssbump/heights/height_field.h"

#include <cstdint>
#include <functional>

namespace rnmbake {

struct DirectionOptions {
  BasisSet set;
  WeightSign sign = WeightSign::free;
  int rays = 250;  // for each texel; at least 8 for each direction
  std::uint64_t seed = 0;
  int threads = 0;  // 0: all cores
};

/// Weights s_i of rows [first_row, last_row), one channel for each direction of the set: E = sum of s_i LM_i
/// with lightmaps as they were baked (encoding/fit/direction_weights.h). The response of a texel is the part
/// of the sky that height_shadows() leaves it, times the cosine to the normal of height_normals().
/// Throws Error(usage) for too few rays. Deterministic for a seed at any number of threads.
[[nodiscard]] FloatImage direction_rows(const HeightField& field, const DirectionOptions& options,
                                        int first_row, int last_row, const std::function<bool()>& stop = {});

}  // namespace rnmbake
