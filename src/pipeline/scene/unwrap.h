// pipeline/scene/unwrap.h - lightmap UVs for the objects that have none.
#pragma once

#include "bake/targets.h"
#include "config/bake_settings.h"
#include "scene/survey.h"

#include <vector>

namespace rnmbake {

struct UnwrapRequest {
  std::size_t object = 0;  // index into SceneSurvey::objects
  ObjectSettings settings;
};

/// UVs in the order of the requests, one for each loop. The margin between charts is that of the settings at
/// the size that the lightmap will have; where it had to be narrowed, that is logged. Objects that share a
/// mesh, a scale and settings share their UVs, so that instances stay instances. Throws Interrupted.
[[nodiscard]] std::vector<Uvs> unwrap(const SceneSurvey& survey, const std::vector<UnwrapRequest>& requests);

}  // namespace rnmbake
