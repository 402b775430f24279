// pipeline/make_targets.h - from a surveyed scene and the settings to the list of what is baked.
#pragma once

#include "bake/targets.h"
#include "config/resolve.h"
#include "pipeline/workspace.h"
#include "scene/survey.h"

#include <string>
#include <vector>

namespace rnmbake {

/// An object of the scene that is not baked, and why.
struct Skipped {
  std::string key, reason;
};

struct TargetList {
  std::vector<Target> targets;
  std::vector<ObjectSettings> settings;  // [targets]
  std::vector<Skipped> skipped;
};

/// Selects objects, splits them, chooses their UVs and sizes; unwraps (one launch of Blender) those that need
/// it. Every object that cannot be baked is logged, then Error(invalid_input) is thrown for the first of
/// them. Error(usage) where a pattern of the settings fits no object.
[[nodiscard]] TargetList make_targets(Workspace& workspace, const Survey& survey);

}  // namespace rnmbake
