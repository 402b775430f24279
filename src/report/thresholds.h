// report/thresholds.h - --fail-above: limits that a comparison must keep.
#pragma once

#include "report/comparison.h"

#include <string>
#include <vector>

namespace rnmbake {

/// "rmse=2%,bias=0.5%,max=0.1": metrics rmse, bias (its size), p95, p99, max; % is of the reference's mean,
/// else E/pi. Throws Error(usage) naming what does not fit.
[[nodiscard]] std::vector<Threshold> parse_thresholds(const std::string& text);

/// Holds every object and basis against the limits. NaN counts as exceeded.
[[nodiscard]] ThresholdOutcome check_thresholds(const Report& report, std::vector<Threshold> thresholds);

/// "rmse 2.00 %".
[[nodiscard]] std::string describe(const Threshold& threshold);

/// One line for each object that exceeded a limit, with its worst basis: "floor: rmse 3.10 % in rnm1 is above
/// 2.00 %; bias ...".
[[nodiscard]] std::vector<std::string> describe(const ThresholdOutcome& outcome);

}  // namespace rnmbake
