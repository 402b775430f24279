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

/// The user's scene as a .blend, and the files that were read to make it, the user's own first.
struct ImportedScene {
  BlendPath blend;
  std::vector<InputFile> inputs;
};

/// A file as a .blend: itself, or imported from glTF or OBJ, which no other step opens. Losses of the import
/// are in the scene's warnings.
[[nodiscard]] ImportedScene import_scene(BlenderSession& session, const std::filesystem::path& file);

/// Survey of a single file (.blend, glTF, OBJ) with its own materials; logs nothing.
[[nodiscard]] SceneSurvey survey_file(BlenderSession& session, const std::filesystem::path& file);

/// Imports, replaces the materials for --materials lambert, surveys; the survey's inputs are those of all
/// these launches, none of them a file of ours. Logs Blender's warnings. Throws Error(invalid_input) where no
/// object has faces.
[[nodiscard]] SurveyResult survey_scene(BlenderSession& session);

/// The scene with every surface showing its own baked albedo and emission through a plain diffuse material.
struct LambertScene {
  BlendPath blend;
  std::vector<std::string> warnings;  // losses against the user's materials
  std::vector<InputFile> inputs;      // files that the user's scene read
  SceneDigest digest;                 // of the user's scene, for this one's baked colours differ by run
};

/// Logs the warnings.
[[nodiscard]] LambertScene make_lambert_scene(BlenderSession& session, const BlendPath& own);

/// Prepends `logged`, lines that were logged before, to the survey's warnings; logs the others.
void log_warnings(SceneSurvey& survey, const std::vector<std::string>& logged = {});

/// Puts files that earlier launches read before those of the survey.
void put_inputs_first(SceneSurvey& survey, std::vector<InputFile> inputs);

/// Launch in a folder of its own that opens a scene, with that part of its request.
[[nodiscard]] Launch launch_on(BlenderSession& session, const char* entry, const char* purpose,
                               const BlendPath& scene);

/// Part of a request that names the file, and scene, view layer and frame in it (opening/choose.py).
[[nodiscard]] nlohmann::json scene_request(const BlenderSession& session, const std::filesystem::path& scene);

}  // namespace rnmbake
