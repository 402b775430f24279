// pipeline/target_facts.h - what a bake and a reference say of a target alike: its surface, its header.
#pragma once

#include "bake/targets.h"
#include "config/bake_settings.h"
#include "lightmap/metadata.h"
#include "scene/surface.h"
#include "scene/survey.h"

namespace rnmbake {

/// World-space triangles with the frames of the target's tangent UVs. Logs where those have no direction.
[[nodiscard]] Surface surface_of(const Survey& survey, const Target& target);

/// All of the header that the target and its settings decide; recipe, horizon, footprint, bounces and
/// Blender's version are the caller's.
[[nodiscard]] LightmapMetadata target_metadata(const Target& target, const ObjectSettings& object,
                                               const OutputSettings& output);

}  // namespace rnmbake
