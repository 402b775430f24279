// scene/survey_meshes.h - the meshes of a survey: arrays cut out of survey.bin, every one checked.
#pragma once

#include "scene/blob.h"
#include "scene/mesh.h"

namespace rnmbake {

/// One mesh from its entry of survey.json. `data` is that of survey.bin. Indices and sizes are checked
/// against each other; positions and UVs must be finite. Normals that are not become the face's.
/// Throws Error(invalid_input) with the text `owner()` in front: "object 'Wall': ".
[[nodiscard]] Mesh read_mesh(const nlohmann::json& entry, Blob& data, const Owner& owner);

}  // namespace rnmbake
