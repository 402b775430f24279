// pipeline/scene_survey.h - opens the scene once and learns all that planning needs.
#pragma once

#include "pipeline/workspace.h"
#include "scene/survey.h"

#include <filesystem>

namespace rnmbake {

struct SurveyedScene {
  Survey survey;
  std::filesystem::path blend;  // what later launches open: the scene, or a .blend made from it
  std::filesystem::path own;    // the same with the user's own materials
};

/// What any one file holds (.blend, glTF, OBJ), with its own materials. `own` is `blend`; nothing is logged.
[[nodiscard]] SurveyedScene survey_file(Workspace& workspace, const std::filesystem::path& file);

/// Imports glTF, replaces the materials for --materials lambert, surveys. Logs what Blender warns of.
/// Throws Error(invalid_input) where there is nothing with faces.
[[nodiscard]] SurveyedScene survey_scene(Workspace& workspace);

/// A .blend in which every surface shows its own baked albedo and emission through a plain diffuse material.
/// Logs what is lost with the user's materials.
[[nodiscard]] std::filesystem::path make_lambert_scene(Workspace& workspace,
                                                       const std::filesystem::path& scene);

/// The part of every request that says which scene it is about.
[[nodiscard]] nlohmann::json scene_request(const Workspace& workspace, const std::filesystem::path& blend);

}  // namespace rnmbake
