// ssbump/heights/bilateral.h - smooths the stair-steps of coarse height maps and keeps their edges.
#pragma once

#include "ssbump/heights/height_field.h"

#include <functional>

namespace rnmbake {

struct BilateralOptions {
  int radius = 10;  // texels; 0: nothing is done
  float edge = 1;   // heights that differ by this much or more do not mix, in the field's units
  int threads = 0;  // 0: all cores
};

/// Every height becomes a mean of those in the disc of `radius` about it. Weights: a Gaussian of the
/// distance, standard deviation radius / 2, times the biweight (1 - (difference / edge)^2)^2 of the heights'
/// difference, 0 from `edge` on (Tomasi & Manduchi, "Bilateral Filtering for Gray and Color Images", 1998).
/// Computed directly, not separated: exact. Heights beyond the borders follow the field's wrap modes.
/// `progress` receives the share that is done, from any thread.
[[nodiscard]] FloatImage bilateral(const HeightField& field, const BilateralOptions& options,
                                   const std::function<void(double)>& progress = {});

}  // namespace rnmbake
