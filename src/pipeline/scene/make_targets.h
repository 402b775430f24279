// pipeline/scene/make_targets.h - from a surveyed scene and the settings to the list of targets.
#pragma once

#include "bake/targets.h"
#include "config/resolve.h"
#include "scene/survey.h"

namespace rnmbake {

/// Selects objects, splits them, chooses their UVs and sizes; unwraps those that need it. Warns of UV
/// problems, one line for each kind. Logs every object that cannot be baked, then throws Error(invalid_input)
/// for the first; also where nothing gives light. Error(usage) where a pattern of the settings fits no
/// object.
[[nodiscard]] TargetList make_targets(const ResolvedConfig& config, const SceneSurvey& survey);

/// Throws Error(invalid_input) where nothing in the scene gives light, unless the settings allow it.
void check_light(const ResolvedConfig& config, const SceneSurvey& survey);

}  // namespace rnmbake
