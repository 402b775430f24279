// ssbump/generate/generate_bounces.h - light that other texels reflect to a texel.
#pragma once

#include "ssbump/generate_options.h"
#include "ssbump/heights/height_field.h"
#include "ssbump/map/weights.h"

#include <functional>

namespace rnmbake {

/// Adds to weight i the light of a sky of radiance max(0, D . B_i)^p after 1 to `bounces` reflections. Texels
/// reflect evenly in all directions, from the surface's own slope. As in the direct part all directions of
/// the upper hemisphere count alike for the texel that receives, and the sum is a share of what an unoccluded
/// texel has: with reflections a weight may exceed 1. `weights` holds the rows from first_row on.
void add_bounces(const HeightField& field, const GenerateOptions& options, int first_row,
                 SsbumpWeights& weights, const std::function<bool()>& stop);

}  // namespace rnmbake
