// lightmap/faults.h - finds texels whose value cannot be right and, when asked, replaces them.
#pragma once

#include "image/float_image.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rnmbake {

enum class TexelFault : std::uint8_t {
  none,
  non_finite,  // NaN or Inf in some channel
  firefly,     // one sample that found a bright light by luck
};

/// A firefly is a covered texel that is more than this many times as bright (mean of the channels) as
/// - the BRIGHTEST of its sound, covered 8 neighbours, of which there must be two or more, and
/// - the median of all sound covered texels.
/// At an edge of light, a streak one texel wide or its end, some neighbour is as bright, so none of them
/// counts. Two fireflies that touch hide each other, and a beam that lights exactly one texel does count:
/// that is why nothing is repaired unasked.
inline constexpr float firefly_ratio = 8;

/// One entry for each texel of `radiance`; uncovered texels are never at fault.
[[nodiscard]] std::vector<TexelFault> find_faults(const FloatImage& radiance, const FloatImage& coverage);

/// Gives every texel at fault the mean of its sound covered neighbours, from the rim of a damaged area
/// inwards; one that no sound texel can reach becomes 0. Sound texels never change. Returns how many were
/// replaced.
std::size_t repair_faults(FloatImage& radiance, const FloatImage& coverage,
                          const std::vector<TexelFault>& faults);

}  // namespace rnmbake
