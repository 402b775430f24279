// pipeline/farm/shared_folders.h - what shows a machine that it looks into the folders of the one that
// planned.
#pragma once

#include "jobs/store.h"
#include "pipeline/farm/farm_plan.h"

#include <filesystem>
#include <string>

namespace rnmbake {

/// Leaves a file of the plan's name in the output folder, and an entry in the cache. Throws Error(io).
void leave_tokens(const FarmPlan& plan, Store& store);

/// Takes the file away once everything is merged.
void remove_token(const FarmPlan& plan);

/// The plan with that id. Throws Error(environment) where this machine sees none, or another: its folder is
/// not shared, or was planned in again.
[[nodiscard]] FarmPlan read_shared_plan(const std::filesystem::path& folder, const std::string& id);

/// Throw Error(environment). A cache or an output that this machine alone sees would swallow what it makes.
void require_shared_cache(const FarmPlan& plan, Store& store);
void require_shared_output(const FarmPlan& plan);

}  // namespace rnmbake
