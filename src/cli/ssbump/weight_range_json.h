// cli/ssbump/weight_range_json.h - weights of a map's channels as `ssbump --json` and `ssbump info --json`
// say them.
#pragma once

#include "ssbump/map/weight_ranges.h"

#include <array>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// Of SsbumpWeights, in the order of its channels.
inline constexpr std::array ssbump_channel_names{"right", "upper left", "lower left", "up", "ambient"};

[[nodiscard]] inline nlohmann::ordered_json json_of(const WeightRange& range) {
  return {{"least", range.least}, {"mean", range.mean}, {"greatest", range.greatest}};
}

}  // namespace rnmbake
