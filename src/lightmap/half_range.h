// lightmap/half_range.h - keeps values within what a half float holds.
#pragma once

#include "image/float_image.h"

#include <cmath>
#include <cstddef>

namespace rnmbake {

inline constexpr float largest_half = 65504;

/// Clamps a finite value to [-65504, 65504]; true where it was beyond. NaN and Inf stay what they are.
inline bool clamp_to_half(float& value) {
  if (!std::isfinite(value) || std::abs(value) <= largest_half) return false;
  value = std::copysign(largest_half, value);
  return true;
}

/// The same for all values; returns how many were beyond.
std::size_t clamp_to_half(FloatImage& image);

}  // namespace rnmbake
