// pipeline/farm/export_flamenco.h - a plan as a job of Flamenco 3, and the job type that it has.
#pragma once

#include "pipeline/farm/farm_plan.h"

#include <filesystem>

namespace rnmbake {

/// PLAN/flamenco.json, whose path is returned: what Flamenco's Manager takes as a new job; beside it
/// rnmbake.flamenco.js, its type, which is the same for all plans.
std::filesystem::path export_flamenco(const FarmPlan& plan);

}  // namespace rnmbake
