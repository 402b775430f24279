// ssbump/generate/generate_bounces.h - light that reaches a texel off other texels.
#pragma once

#include "ssbump/generate_options.h"
#include "ssbump/heights/height_field.h"
#include "ssbump/map/weights.h"

#include <functional>

namespace rnmbake {

/// Adds to weight i what arrives after 1 to `bounces` reflections while the sky sends max(0, D . B_i)^p from
/// above. Texels reflect evenly in all directions, from the surface's own slope. As in the direct part all
/// directions of the upper hemisphere count alike for the texel that receives, and the sum is a share of what
/// an unoccluded texel has: with reflections a weight may exceed 1. `weights` holds the rows from first_row
/// on.
void add_bounces(const HeightField& field, const GenerateOptions& options, int first_row,
                 SsbumpWeights& weights, const std::function<bool()>& stop);

}  // namespace rnmbake
