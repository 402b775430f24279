#include "pipeline/scene/scene_survey.h"

#include "base/error.h"
#include "base/log.h"
#include "base/object_notes.h"
#include "blender/blend_header.h"
#include "config/sun.h"
#include "pipeline/scene/launch_answer.h"
#include "scene/survey_parse.h"

#include <algorithm>
#include <utility>

namespace rnmbake {

namespace fs = std::filesystem;

namespace {

/// Warns of a scene from a later Blender, which this one opens without the data that it does not know.
void warn_of_newer(const BlenderSession& session, const BlendPath& scene) {
  const std::string newer =
      newer_blend(scene.path(), session.blender().info(), "which leaves out what it does not know");
  if (!newer.empty()) log::warn("{}", newer);
}

SceneSurvey survey_blend(BlenderSession& session, const BlendPath& blend) {
  Launch launch = launch_on(session, "survey_entry.py", "survey", blend);
  // Blender 3.4 adds up normals of vertices in the order in which its threads come by, so that last digits,
  // and with them the keys of the cache, were others now and then.
  launch.threads = 1;
  const nlohmann::json answer = session.run(launch);
  warn_of_newer(session, blend);
  return read_survey(answered_file(answer, "survey", launch.folder));
}

}  // namespace

nlohmann::json scene_request(const BlenderSession& session, const fs::path& scene) {
  const SceneSettings& settings = session.settings().scene;
  nlohmann::json request{{"scene", fs::absolute(scene).string()},
                         {"allow_scripts", settings.allow_scripts},
                         {"scene_name", settings.scene},
                         {"view_layer", settings.view_layer},
                         {"frame", settings.frame}};
  if (settings.sky > 0) request["sky"] = settings.sky;
  if (const auto sun = sun_of(settings.sun)) request["sun"] = {sun->azimuth, sun->elevation, sun->strength};
  return request;
}

Launch launch_on(BlenderSession& session, const char* entry, const char* purpose, const BlendPath& scene) {
  Launch launch;
  launch.entry = entry;
  launch.scene = scene;
  launch.request = scene_request(session, scene.path());
  launch.folder = session.new_folder(purpose);
  return launch;
}

ImportedScene import_scene(BlenderSession& session, const fs::path& file) {
  const InputFile scene{"scene", fs::absolute(file).lexically_normal(), true};
  if (is_blend(file)) return {BlendPath(file), {scene}};
  Launch launch;
  launch.entry = "import_entry.py";
  launch.request = scene_request(session, file);
  launch.folder = session.new_folder("import");
  const nlohmann::json answer = session.run(launch);
  ImportedScene imported{BlendPath(answered_file(answer, "blend", launch.folder)), {scene}};
  add_inputs(imported.inputs, read_inputs(answer.at("inputs")));
  return imported;
}

LambertScene make_lambert_scene(BlenderSession& session, const BlendPath& own) {
  log::info("baking albedo and emission of every material");
  const Launch launch = launch_on(session, "lambert_entry.py", "lambert", own);
  const nlohmann::json answer = session.run(launch);
  warn_of_newer(session, own);
  LambertScene result{BlendPath(answered_file(answer, "blend", launch.folder)),
                      answer.at("warnings").get<std::vector<std::string>>(), read_inputs(answer.at("inputs")),
                      read_digest(answer.at("digest"))};
  warn_of_objects(result.warnings);
  return result;
}

void put_inputs_first(SceneSurvey& survey, std::vector<InputFile> inputs) {
  add_inputs(inputs, survey.inputs);
  survey.inputs = std::move(inputs);
}

void log_warnings(SceneSurvey& survey, const std::vector<std::string>& logged) {
  std::vector<std::string> all = logged, fresh;
  for (const std::string& warning : survey.warnings) {
    if (std::ranges::find(all, warning) != all.end()) continue;
    fresh.push_back(warning);
    all.push_back(warning);
  }
  warn_of_objects(fresh);
  survey.warnings = std::move(all);
}

SceneSurvey survey_file(BlenderSession& session, const fs::path& file) {
  const ImportedScene imported = import_scene(session, file);
  SceneSurvey survey = survey_blend(session, imported.blend);
  put_inputs_first(survey, imported.inputs);
  return survey;
}

SurveyResult survey_scene(BlenderSession& session) {
  const SceneSettings& scene = session.settings().scene;
  ImportedScene imported = import_scene(session, scene.file);
  SceneBlends blends{imported.blend, imported.blend};
  std::vector<std::string> logged;
  SceneDigest own_digest;
  if (scene.materials == SceneSettings::Materials::lambert) {
    LambertScene lambert = make_lambert_scene(session, blends.own);
    add_inputs(imported.inputs, lambert.inputs);
    blends.shown = lambert.blend;
    own_digest = std::move(lambert.digest);
    logged = std::move(lambert.warnings);
  }
  SurveyResult result{survey_blend(session, blends.shown), blends};
  if (!own_digest.empty()) result.survey.digest = std::move(own_digest);
  result.survey.scene_file = scene.file.string();
  put_inputs_first(result.survey, imported.inputs);
  log_warnings(result.survey, logged);
  if (result.survey.objects.empty()) {
    fail(ExitCode::invalid_input,
         "{}: nothing in this scene renders as a surface: is everything hidden from rendering?",
         scene.file.string());
  }
  return result;
}

}  // namespace rnmbake
