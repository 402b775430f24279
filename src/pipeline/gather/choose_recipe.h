// pipeline/gather/choose_recipe.h - which recipe a scene is baked by.
#pragma once

#include "bake/targets.h"
#include "config/bake_settings.h"
#include "scene/survey.h"

#include <string>
#include <vector>

namespace rnmbake {

/// What keeps recipe gather from being exact, one line each; none: it is.
[[nodiscard]] std::vector<std::string> against_gather(const BakeSettings& settings, const SceneSurvey& survey,
                                                      const std::vector<ObjectSettings>& objects);

/// The recipe of the settings; of `auto` gather where it is exact, else receiver, which is logged. Throws
/// Error(unsupported) where gather was asked for and is not exact.
[[nodiscard]] BakingSettings::Recipe choose_recipe(const BakeSettings& settings, const SceneSurvey& survey,
                                                   const std::vector<ObjectSettings>& objects);

}  // namespace rnmbake
