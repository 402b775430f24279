// scene/loose_parts.h - the parts of a mesh that share no vertex.
#pragma once

#include "scene/mesh.h"

#include <cstdint>
#include <vector>

namespace rnmbake {

/// The part of each triangle; parts count up from 0 in the order of their first triangle.
/// Triangles that share a vertex (by index, as Blender's "separate by loose parts") share a part.
[[nodiscard]] std::vector<std::uint32_t> loose_parts(const Mesh& mesh);

}  // namespace rnmbake
