// cli/bake_several.h - several scenes of one bake.
#pragma once

#include "cli/run_report.h"
#include "config/resolve.h"

#include <functional>
#include <vector>

namespace rnmbake {

/// Bakes one scene: returns its exit code, throws Error where it failed as a whole.
using BakeOne = std::function<int(const ResolvedConfig&, RunReport&)>;

/// One after the other, each with all cores; one that fails stops no other. Returns the worst exit code: what
/// failed as a whole is worse than objects that failed, and of what is as bad the first counts. Unless
/// `is_plan`, says in one line what there is at the end. Throws Interrupted.
int bake_several(const std::vector<ResolvedConfig>& configs, const BakeOne& bake, bool is_plan,
                 RunReport& made);

}  // namespace rnmbake
