// ssbump/map/weight_ranges.h - least, greatest and mean weight of each channel of a map.
#pragma once

#include "image/float_image.h"

#include <cstddef>
#include <vector>

namespace rnmbake {

/// Of one channel, as weights: 1 is open.
struct WeightRange {
  float least = 0, greatest = 0;
  double mean = 0;
};

/// Over rows that come one after another, all of as many channels.
class WeightRanges {
 public:
  void add(const FloatImage& weights);

  /// [channels]; none before the first row.
  [[nodiscard]] std::vector<WeightRange> ranges() const;

 private:
  std::vector<WeightRange> sums_;  // `mean` is the sum
  std::size_t texels_ = 0;
};

}  // namespace rnmbake
