// pipeline/farm/make_plan.h - from a bake's settings to a plan folder.
#pragma once

#include "pipeline/bake/bake_run.h"
#include "pipeline/farm/farm_plan.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

struct FarmOptions {
  std::filesystem::path folder;    // of the plan
  double task_seconds = 15 * 60;   // predicted length of a task
  std::vector<std::string> merge;  // arguments of the bake that merges, as they were typed
};

/// Refuses what cannot be cut into tasks beforehand: --noise, --time, flat-normal-map, no cache. Throws
/// Error(usage).
void require_farmable(const ResolvedConfig& config);

/// Makes memory and jobs that atlases are laid out for independent of the machine that asks.
void settle_layout(BakeSettings& settings);

/// The folder, emptied of an earlier plan. Throws Error(usage) where it holds something else.
void prepare_plan_folder(const std::filesystem::path& folder);

/// Plans as a bake would that finds the same in the cache, and notes there what it found missing, so that
/// that bake has the same batches. `session` has its folder in the plan's.
[[nodiscard]] FarmPlan make_farm_plan(BlenderSession& session, const BakeSubject& subject, Store& store,
                                      const FarmOptions& options);

}  // namespace rnmbake
