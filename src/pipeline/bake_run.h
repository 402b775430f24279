// pipeline/bake_run.h - one bake by Blender: from targets to lightmaps and manifest.
#pragma once

#include "basis/basis_set.h"
#include "pipeline/deliver_lightmap.h"
#include "pipeline/dispatcher.h"
#include "pipeline/make_targets.h"
#include "pipeline/scene_survey.h"
#include "pipeline/workspace.h"

#include <vector>

namespace rnmbake {

/// What a bake came to.
struct BakeOutcome {
  std::vector<Delivery> deliveries;  // [targets]
  BakeTimings timings;
};

/// Bakes all targets for all `bases` as the workspace's settings say, into their output folder, and writes
/// the scene with its UVs and the manifest. What fails is logged and in the manifest. Neither scene nor
/// targets are changed or worked out again: several bakes of one scene share them, each with a workspace of
/// its own settings. Throws Interrupted, and Error where going on makes no sense.
[[nodiscard]] BakeOutcome run_bake(Workspace& workspace, const SurveyedScene& scene, const TargetList& list,
                                   const std::vector<BasisDirection>& bases);

}  // namespace rnmbake
