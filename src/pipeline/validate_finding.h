// pipeline/validate_finding.h - a validation in one sentence.
#pragma once

#include "report/comparison.h"

#include <string>

namespace rnmbake {

/// "receiver: no bias beyond the noise ...", or how many objects have one, and the worst.
[[nodiscard]] std::string receiver_finding(const Report& receiver);

/// "flat-normal-map: -13 % on average, of which bump shadowing ...; unexplained ...". Of the bases other than
/// flat, where there are any.
[[nodiscard]] std::string recipe_finding(const Decomposition& scene);

}  // namespace rnmbake
