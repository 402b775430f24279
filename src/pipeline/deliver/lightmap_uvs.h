// pipeline/deliver/lightmap_uvs.h - where the surfaces of a saved scene lie on their lightmaps.
#pragma once

#include "base/math.h"
#include "blender/blender_session.h"

#include <string>
#include <vector>

namespace rnmbake {

/// Of each object, by its name in the session's scene: three UVs for each triangle, v up, [0,1] is the map.
/// Throws as BlenderSession::run().
[[nodiscard]] std::vector<std::vector<Vec2>> lightmap_uvs(BlenderSession& session,
                                                          const std::vector<std::string>& objects);

}  // namespace rnmbake
