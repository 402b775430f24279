// pipeline/validate/validate_finding.h - a validation in one sentence.
#pragma once

#include "report/comparison.h"

#include <string>
#include <vector>

namespace rnmbake {

/// "receiver: no bias beyond the noise ...", or the number of biased objects and the worst; then the loss by
/// the limit of bounces. `receiver` is held against the truth with that limit. Where Cycles has light that
/// the reference does not follow, a difference is not called a bias.
[[nodiscard]] std::string receiver_finding(const Report& receiver);

/// "flat-normal-map: -13 % on average, of which bump shadowing ...; unexplained ...". Of the bases other than
/// flat, where there are any. `not_followed`: as in Report.
[[nodiscard]] std::string recipe_finding(const Decomposition& scene,
                                         const std::vector<std::string>& not_followed);

/// The relative bias over the scene, of all bases together.
[[nodiscard]] Statistic scene_bias(const Report& report);

}  // namespace rnmbake
