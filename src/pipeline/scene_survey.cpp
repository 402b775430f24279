#include "pipeline/scene_survey.h"

#include "base/error.h"
#include "base/log.h"
#include "base/object_notes.h"
#include "blender/blend_header.h"
#include "pipeline/launch_answer.h"

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

bool is_blend(const fs::path& file) {
  return file.extension() == ".blend";
}

Launch launch_on(Workspace& workspace, const char* entry, const char* purpose, const fs::path& scene) {
  Launch launch;
  launch.entry = entry;
  if (is_blend(scene)) {
    launch.scene = scene;
    const std::string newer = newer_blend(scene, workspace.blender().info());
    if (!newer.empty()) log::warn("{}", newer);
  }
  launch.request = scene_request(workspace, scene);
  launch.folder = workspace.new_folder(purpose);
  return launch;
}

}  // namespace

fs::path make_lambert_scene(Workspace& workspace, const fs::path& scene) {
  log::info("baking albedo and emission of every material");
  const Launch launch = launch_on(workspace, "lambert_entry.py", "lambert", scene);
  const nlohmann::json answer = workspace.run(launch);
  warn_of_objects(answer.at("warnings").get<std::vector<std::string>>());
  return answered_file(answer, "blend", launch.folder);
}

nlohmann::json scene_request(const Workspace& workspace, const fs::path& blend) {
  return {{"scene", fs::absolute(blend).string()},
          {"allow_scripts", workspace.settings().scene.allow_scripts}};
}

SurveyedScene survey_file(Workspace& workspace, const fs::path& file) {
  SurveyedScene result;
  result.blend = fs::absolute(file);
  Launch launch = launch_on(workspace, "survey_entry.py", "survey", result.blend);
  const fs::path folder = launch.folder;
  const nlohmann::json answer = workspace.run(std::move(launch));
  result.survey = read_survey(answered_file(answer, "survey", folder));
  if (const auto imported = answer.find("blend"); imported != answer.end() && imported->is_string()) {
    result.blend = answered_file(*imported, folder);
  }
  result.own = result.blend;
  return result;
}

SurveyedScene survey_scene(Workspace& workspace) {
  const SceneSettings& scene = workspace.settings().scene;
  const fs::path file = fs::absolute(scene.file);
  const bool lambert = scene.materials == SceneSettings::Materials::lambert;
  SurveyedScene result = survey_file(workspace, lambert ? make_lambert_scene(workspace, file) : file);
  if (lambert) result.own = file;
  warn_of_objects(result.survey.warnings);
  if (result.survey.objects.empty()) {
    fail(ExitCode::invalid_input,
         "{}: nothing in this scene renders as a surface: is everything hidden from rendering?",
         scene.file.string());
  }
  return result;
}

}  // namespace rnmbake
