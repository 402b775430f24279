// pipeline/bake/bake_run.h - one bake by Blender: from targets to lightmaps and manifest.
#pragma once

#include "blender/blender_session.h"
#include "encoding/basis_set.h"
#include "pipeline/dispatch/bake_timings.h"
#include "pipeline/dispatch/dispatcher.h"
#include "pipeline/lightmaps/deliver_lightmap.h"
#include "pipeline/lightmaps/earlier_lightmaps.h"
#include "pipeline/scene/make_targets.h"
#include "pipeline/scene/scene_survey.h"
#include "scene/survey.h"

#include <functional>
#include <string>
#include <vector>

namespace rnmbake {

/// Result of a bake.
struct BakeOutcome {
  std::vector<Delivery> deliveries;  // [targets]
  BakeTimings timings;
};

/// Targets, bases and scene files of a bake; shared by several bakes of one scene.
struct BakeSubject {
  const SceneSurvey& survey;
  const TargetList& list;
  const std::vector<BasisDirection>& bases;
  SceneBlends blends;             // `shown` is baked, `own` saved with new UVs
  EarlierLightmaps earlier = {};  // stays in the manifest
  DispatchRules rules = {};       // what was baked before, and how long it may take
};

/// Bakes all targets for all bases as the session's settings say, into their output folder, and writes the
/// scene with its UVs and the manifest. What fails is logged and in the manifest. Samples, seed and the like
/// come from the list's own settings. Throws Interrupted, and Error where going on makes no sense.
[[nodiscard]] BakeOutcome run_bake(BlenderSession& session, const BakeSubject& subject);

/// What a bake would do with a target.
struct BakePreview {
  std::string key;
  bool is_kept = false;  // all of it was baked before
  int samples = 0;       // wanted
};

/// Looks for what was baked before; nothing is baked or written.
[[nodiscard]] std::vector<BakePreview> preview_bake(BlenderSession& session, const BakeSubject& subject);

/// Plans a bake as run_bake() does, and hands over its plan and how batches are asked for; nothing is baked.
void plan_only(const BlenderSession& session, const BakeSubject& subject,
               const std::function<void(const Plan&, const BatchRecipe&)>& use);

}  // namespace rnmbake
