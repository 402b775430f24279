// bake/glow.h - heights of receivers over emissive faces.
//
// Cycles aims light samples at the glowing face right under a receiver, and the part of a tilted normal's
// lobe that lies below the face would take its light in (blender_scripts/bake/glow.py).
#pragma once

#include "scene/surface.h"
#include "scene/survey.h"

#include <cstddef>
#include <map>
#include <string>

namespace rnmbake {

/// The highest receiver on each emitting material, world units.
using GlowHeights = std::map<std::string, float>;

/// Takes in the receivers on one object (an index into SceneSurvey::objects), or on a part of it.
void note_glow(GlowHeights& heights, const SceneSurvey& survey, std::size_t object, const Surface& surface);

}  // namespace rnmbake
