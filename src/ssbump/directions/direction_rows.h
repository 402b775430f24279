// ssbump/directions/direction_rows.h - weights of a height field's texels for any set of directions, by rays.
#pragma once

#include "encoding/basis_set.h"
#include "encoding/fit/direction_weights.h"
#include "image/float_image.h"
#include "ssbump/heights/height_field.h"
#include "ssbump/heights/height_shadows.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace rnmbake {

struct DirectionOptions {
  BasisSet set;
  WeightSign sign = WeightSign::free;
  int rays = 250;  // for each texel; at least 8 for each direction
  std::uint64_t seed = 0;
  int threads = 0;  // 0: all cores
};

/// Weights s_i, one channel for each direction of the set: E = sum of s_i LM_i with lightmaps as they were
/// baked (encoding/fit/direction_weights.h). The response of a texel is the part of the sky that
/// height_shadows() leaves it, times the cosine to the normal of height_normals(). Deterministic for a seed
/// at any number of threads.
class DirectionRows {
 public:
  /// Refers to `field`. Throws Error(usage) for too few rays.
  DirectionRows(const HeightField& field, DirectionOptions options);

  /// Rows [first_row, last_row); unfinished once `stop` says true.
  [[nodiscard]] FloatImage rows(int first_row, int last_row, const std::function<bool()>& stop = {}) const;

 private:
  /// Directions of a texel's rays, and the weights that fit what it sees along them.
  struct RaySet {
    std::vector<Vec3> directions;
    DirectionWeights weights;
  };

  const HeightField& field_;
  DirectionOptions options_;
  HeightRays surface_;
  std::vector<RaySet> sets_;  // neighbouring texels take unlike ones
};

}  // namespace rnmbake
