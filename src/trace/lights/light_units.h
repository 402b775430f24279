// trace/lights/light_units.h - lamps out of Blender's numbers, whose units depend on its version.
#pragma once

#include "scene/survey.h"
#include "trace/lights/lamp.h"

#include <string>
#include <vector>

namespace rnmbake {

/// The lamps that emit, in the survey's order, by the units of that Blender ("3.4.1"): measured against bakes
/// of each version (docs/reference.md). Positions are relative to `origin`.
[[nodiscard]] std::vector<Lamp> read_lamps(const SceneSurvey& survey, const std::string& blender_version,
                                           const Vec3d& origin = Vec3d(0));

}  // namespace rnmbake
