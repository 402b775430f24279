// ssbump/generate/hemisphere_rays.h - rays over a hemisphere, with the weight of each in every channel of a
// texel.
#pragma once

#include "base/math.h"
#include "ssbump/map/weights.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rnmbake {

using SsbumpChannels = std::array<float, SsbumpWeights::channels>;

/// A direction in tangent space, and max(0, D . axis)^p for the axis and the power of each channel.
struct WeightedRay {
  Vec3 direction;
  SsbumpChannels weight;
};

/// Several sets of rays, evenly spread over the upper hemisphere (a Hammersley set each, moved and turned).
/// Neighbouring texels take different ones, so that the error of a set does not show as a pattern. Every set
/// sums to the whole hemisphere in each channel, so that an unoccluded texel is 1 exactly.
class HemisphereRays {
 public:
  HemisphereRays(int rays, double power, std::uint64_t seed);

  [[nodiscard]] const std::vector<WeightedRay>& set(std::uint64_t number) const {
    return sets_[number % sets_.size()];
  }

 private:
  std::vector<std::vector<WeightedRay>> sets_;
};

}  // namespace rnmbake
