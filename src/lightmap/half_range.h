// lightmap/half_range.h - keeps values within what a half float holds.
#pragma once

#include "image/float_image.h"

#include <cstddef>

namespace rnmbake {

inline constexpr float largest_half = 65504;

/// Clamps finite values to [-65504, 65504] and returns how many were beyond. NaN and Inf stay what they are.
std::size_t clamp_to_half(FloatImage& image);

}  // namespace rnmbake
