// pipeline/farm/run_task.h - what a node does: bakes the passes of one task into the cache.
#pragma once

#include "pipeline/farm/farm_plan.h"
#include "pipeline/farm/task_result.h"

#include <cstddef>

namespace rnmbake {

/// Launches Blender for those passes of the task that the cache lacks, with the retries of the plan's
/// settings; a failing batch is split until the offender is alone, as in a bake. Writes tasks/N.json; where
/// it was stopped or killed there is none. May run several times, and at the same time. Throws Interrupted,
/// Error(usage) where there is no such task, and Error where this machine cannot run any (no such Blender,
/// another cache): then that is the result, too.
[[nodiscard]] TaskResult run_task(const FarmPlan& plan, std::size_t task, const NodeSettings& node);

}  // namespace rnmbake
