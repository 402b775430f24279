// pipeline/scene/scene_survey.h - opens the scene once and learns all that planning needs.
#pragma once

#include "blender/blend_path.h"
#include "blender/blender_session.h"
#include "scene/survey.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

/// One scene as the .blend files that launches open.
struct SceneBlends {
  BlendPath shown;  // what is baked: `own`, or one made from it with lambert materials
  BlendPath own;    // with the user's own materials
};

struct SurveyResult {
  SceneSurvey survey;
  SceneBlends blends;
};

/// A file as a .blend: itself, or what Blender's importer makes of glTF and OBJ. The one step that opens what
/// is no .blend; what the import could not carry over stands in the scene's warnings.
[[nodiscard]] BlendPath import_scene(BlenderSession& session, const std::filesystem::path& file);

/// What any one file holds (.blend, glTF, OBJ), with its own materials; nothing is logged.
[[nodiscard]] SceneSurvey survey_file(BlenderSession& session, const std::filesystem::path& file);

/// Imports, replaces the materials for --materials lambert, surveys. Logs what Blender warns of.
/// Throws Error(invalid_input) where there is nothing with faces.
[[nodiscard]] SurveyResult survey_scene(BlenderSession& session);

/// The scene with every surface showing its own baked albedo and emission through a plain diffuse material.
struct LambertScene {
  BlendPath blend;
  std::vector<std::string> warnings;  // what is lost with the user's materials
};

/// Logs the warnings.
[[nodiscard]] LambertScene make_lambert_scene(BlenderSession& session, const BlendPath& own);

/// Puts lines that were logged before in front of the survey's warnings, and logs those that are new.
void log_warnings(SceneSurvey& survey, const std::vector<std::string>& logged = {});

/// A launch that opens a scene, with the part of its request that says which one and in a folder of its own.
[[nodiscard]] Launch launch_on(BlenderSession& session, const char* entry, const char* purpose,
                               const BlendPath& scene);

/// The part of every request that says which scene it is about.
[[nodiscard]] nlohmann::json scene_request(const BlenderSession& session, const std::filesystem::path& scene);

}  // namespace rnmbake
