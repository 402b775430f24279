// pipeline/farm/cut_tasks.h - passes of batches as tasks of about equal length.
#pragma once

#include "pipeline/farm/farm_plan.h"

#include <vector>

namespace rnmbake {

/// Before the first pass of a launch: Blender's start and the scene, by the model of bake/sample_passes.h.
[[nodiscard]] double launch_seconds(std::int64_t scene_triangles);

/// Tasks of about `wanted` seconds: passes stay in their order, and are whole. `start` is what each launch
/// costs before its first pass.
[[nodiscard]] std::vector<FarmTask> cut_tasks(const std::vector<FarmBatch>& batches, double wanted,
                                              double start);

/// The longest task over the mean.
[[nodiscard]] double imbalance(const std::vector<FarmTask>& tasks);

}  // namespace rnmbake
