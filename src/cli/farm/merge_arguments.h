// cli/farm/merge_arguments.h - the command that merges what the tasks of a plan baked.
#pragma once

#include "config/resolve.h"
#include "pipeline/farm/farm_plan.h"

#include <string>
#include <vector>

namespace rnmbake {

/// Scene or project file, and a flag for each setting that a flag or the environment set.
[[nodiscard]] std::vector<std::string> merge_arguments(const ResolvedConfig& config,
                                                       const std::string& scene_argument);

/// As one would type it in the plan's work folder: "rnmbake bake ... --merge PLAN".
[[nodiscard]] std::string merge_command(const FarmPlan& plan, const std::string& program = "rnmbake");

}  // namespace rnmbake
