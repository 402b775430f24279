// pipeline/scene/scene_key.h - what light depends on, as a key for results that are kept.
#pragma once

#include "blender/blender_session.h"
#include "jobs/key.h"
#include "scene/survey.h"

namespace rnmbake {

/// Content of the scene as Cycles sees it, materials that were asked for, Blender and its scripts; not the
/// scene's path, nor what is baked of it.
[[nodiscard]] ResultKey scene_key(const BlenderSession& session, const SceneSurvey& survey);

}  // namespace rnmbake
