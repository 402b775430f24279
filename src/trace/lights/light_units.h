// trace/lights/light_units.h - what the numbers of Blender's lamps mean in the version that bakes.
#pragma once

#include "scene/survey.h"
#include "trace/lights/lamp.h"

#include <string>
#include <vector>

namespace rnmbake {

/// The lamps that give light, in the survey's order, each in the units of that Blender ("3.4.1"):
/// measured against bakes of each (docs/reference.md). Places are relative to `origin`.
[[nodiscard]] std::vector<Lamp> read_lamps(const SceneSurvey& survey, const std::string& blender_version,
                                           const Vec3d& origin = Vec3d(0));

}  // namespace rnmbake
