// pipeline/scene/make_targets.h - from a surveyed scene and the settings to the list of what is baked.
#pragma once

#include "bake/targets.h"
#include "config/resolve.h"
#include "scene/survey.h"

namespace rnmbake {

/// Selects objects, splits them, chooses their UVs and sizes; unwraps those that need it. What a lightmap
/// cannot show of its surface is warned of, one line for each kind. Every object that cannot be baked is
/// logged, then Error(invalid_input) is thrown for the first of them; also where nothing gives light.
/// Error(usage) where a pattern of the settings fits no object.
[[nodiscard]] TargetList make_targets(const ResolvedConfig& config, const SceneSurvey& survey);

/// Throws Error(invalid_input) where nothing in the scene gives light, unless the settings allow it.
void check_light(const ResolvedConfig& config, const SceneSurvey& survey);

}  // namespace rnmbake
