// pipeline/farm/export_openjd.h - a plan as a job of queues that take Open Job Description templates.
#pragma once

#include "pipeline/farm/farm_plan.h"

#include <filesystem>

namespace rnmbake {

/// PLAN/openjd.json, whose path is returned: a template (jobtemplate-2023-09) with the steps `bake`, a task
/// of the plan for each of its tasks, and `merge`, which waits for them.
std::filesystem::path export_openjd(const FarmPlan& plan);

}  // namespace rnmbake
