// ssbump/map/combine.h - a detail texture over a self-shadowed bump map.
#pragma once

#include "image/float_image.h"

namespace rnmbake {

enum class Combine { even, channels };

/// Multiplies weights by those of the detail (both SsbumpWeights), tiled `repeat` times over each axis and
/// looked up bilinearly. even: all channels but ambient by the mean of the detail's three, which leaves every
/// bent normal as it is. channels: each by its own, so that the detail's bumps show, too. Ambient occlusion
/// is multiplied by the detail's in both.
void combine_detail(FloatImage& weights, const FloatImage& detail, double repeat, Combine how);

}  // namespace rnmbake
