// scene/survey_meshes.h - the meshes of a survey: arrays cut out of survey.bin, every one checked.
#pragma once

#include "scene/mesh.h"

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// One mesh from its entry of survey.json. `data` is the whole of survey.bin. Indices and sizes are checked
/// against each other; positions and UVs must be finite. Normals that are not become the face's.
/// Throws Error(invalid_input) with the text `owner()` in front: "object 'Wall': ".
[[nodiscard]] Mesh read_mesh(const nlohmann::json& entry, const std::vector<char>& data,
                             const std::function<std::string()>& owner);

}  // namespace rnmbake
