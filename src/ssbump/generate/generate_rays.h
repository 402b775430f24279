// ssbump/generate/generate_rays.h - weights by rays: the truth that the horizon's are measured against, and
// cones.
#pragma once

#include "ssbump/generate_options.h"
#include "ssbump/heights/height_field.h"
#include "ssbump/map/weights.h"

#include <functional>

namespace rnmbake {

/// Rows first_row .. last_row - 1 by SsbumpMethod::trace or ::cone.
[[nodiscard]] SsbumpWeights rays_rows(const HeightField& field, const GenerateOptions& options, int first_row,
                                      int last_row, const std::function<void(double)>& progress,
                                      const std::function<bool()>& stop);

}  // namespace rnmbake
