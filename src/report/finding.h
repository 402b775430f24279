// report/finding.h - numbers as people write them, and a comparison in one sentence.
#pragma once

#include "report/comparison.h"

#include <string>

namespace rnmbake {

/// Three significant digits: "0.0123", "12.3", "1230".
[[nodiscard]] std::string number(double value);

/// A share as percent with its interval: "+0.12 % (-0.05 to +0.29)"; without a sign for sizes.
[[nodiscard]] std::string percent(double share);
[[nodiscard]] std::string percent(const Statistic& share, bool with_sign);

/// Sentence on the whole scene: bias and whether its interval holds 0, RMSE, and the worst object.
[[nodiscard]] std::string finding_of(const Report& report);

}  // namespace rnmbake
