#include "ssbump/map/weight_ranges.h"

#include <algorithm>

namespace rnmbake {

void WeightRanges::add(const FloatImage& weights) {
  const std::vector<float>& data = weights.data();
  if (data.empty()) return;
  if (texels_ == 0) {
    for (int c = 0; c < weights.channels(); ++c) {
      const float first = data[static_cast<std::size_t>(c)];
      sums_.push_back({first, first, 0});
    }
  }
  for (std::size_t c = 0; c < sums_.size(); ++c) {
    WeightRange& range = sums_[c];
    for (std::size_t at = c; at < data.size(); at += sums_.size()) {
      range.least = std::min(range.least, data[at]);
      range.greatest = std::max(range.greatest, data[at]);
      range.mean += double{data[at]};
    }
  }
  texels_ += weights.texels();
}

std::vector<WeightRange> WeightRanges::ranges() const {
  std::vector<WeightRange> ranges = sums_;
  for (WeightRange& range : ranges) range.mean /= static_cast<double>(texels_);
  return ranges;
}

}  // namespace rnmbake
