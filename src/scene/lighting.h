// scene/lighting.h - whether a scene has any light.
#pragma once

#include "scene/survey.h"

namespace rnmbake {

/// False only where nothing in the scene can give light: no lamp, no sky, no material that emits and nothing
/// whose light only a render would tell.
[[nodiscard]] bool may_be_lit(const SceneSurvey& survey);

}  // namespace rnmbake
