// unwrap/chart_samples.h - the samples of the plane that a chart covers already.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace rnmbake {

/// Samples lie in the middle of the unit squares. Triangles that share an edge share no sample, exactly.
class ChartSamples {
 public:
  /// `corners`: three for each triangle.
  [[nodiscard]] bool any(const std::vector<Imath::V2d>& corners) const;
  void add(const std::vector<Imath::V2d>& corners);
  void clear() { tiles_.clear(); }

 private:
  std::unordered_map<std::uint64_t, std::uint64_t> tiles_;  // 8 x 8 samples each
};

}  // namespace rnmbake
