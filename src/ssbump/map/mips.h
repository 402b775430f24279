// ssbump/map/mips.h - smaller and smaller versions of a map, each texel the mean of what it covers.
#pragma once

#include "image/float_image.h"

namespace rnmbake {

/// Half the size, rounded down, at least 1. Every texel is the mean over its area, which at odd sizes cuts
/// through texels. Right for weights because light is linear in them; a normal map's mean is shorter than 1
/// and lights another slope.
[[nodiscard]] FloatImage half_size(const FloatImage& image);

/// Number of halvings down to one texel.
[[nodiscard]] int mip_levels(int width, int height);

}  // namespace rnmbake
