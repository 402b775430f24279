// lightmap/half_errors.h - standard errors out of two independent halves of a bake.
#pragma once

#include "image/bakes.h"
#include "lightmap/extra_layers.h"

#include <vector>

namespace rnmbake {

/// What the difference of two halves says.
struct HalfErrors {
  std::vector<ExtraLayers::StandardError> layers;  // [bases]
  /// Root mean square of the texels' errors over their mean, of the worst direction; what the manifest says.
  double relative = 0;
};

/// `a` and `b`: the same target from two halves. `variance_factor`: from the square of their difference to
/// the variance of their mean, 1/4 for halves of the same size. One difference says little of a texel's own
/// error, so the picture holds, for each texel, the root mean square over the covered ones among the 5 x 5
/// around it: a texel's error is within twice that in about 95 % of texels. `relative` does without that.
[[nodiscard]] HalfErrors half_errors(const TargetBakes& a, const TargetBakes& b, double variance_factor);

}  // namespace rnmbake
