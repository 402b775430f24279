// tests/with_blender/survey_session.h - builds a scene with the installed Blender and surveys it.
#pragma once

#include "base/error.h"
#include "base/files.h"
#include "blender/find.h"
#include "blender/probe.h"
#include "blender/real_blender.h"
#include "process/run.h"
#include "scene/survey_parse.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

class SurveySession {
 public:
  SurveySession()
      : blender_(probe_version(find_blender()),
                 RealBlender::Options{{}, std::filesystem::path(RNMBAKE_SOURCE_DIR "/blender_scripts")}) {}

  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
  [[nodiscard]] const BlenderInfo& info() const { return blender_.info(); }

  /// Runs tests/with_blender/scenes/`script` in Blender.
  void build(const std::string& script, const std::vector<std::string>& arguments) {
    ProcessOptions options;
    options.argv = {info().executable.string(),
                    "-b",
                    "--factory-startup",
                    "-noaudio",
                    "--python-exit-code",
                    "86",
                    "--python",
                    scenes + script,
                    "--"};
    options.argv.insert(options.argv.end(), arguments.begin(), arguments.end());
    const ProcessResult result = run_process(options);
    if (!result.succeeded()) fail(ExitCode::tasks_failed, "{}: {}", script, result.output);
  }

  /// What is no .blend is imported first.
  LaunchOutcome launch(const std::filesystem::path& scene, const std::string& entry = "survey_entry.py") {
    if (is_blend(scene)) return launch_on(BlendPath(scene), scene, entry);
    const LaunchOutcome imported = import_only(scene);
    if (!std::holds_alternative<Finished>(imported)) return imported;
    const auto blend = std::get<Finished>(imported).result.at("blend").get<std::string>();
    return launch(last_folder_ / blend, entry);
  }

  LaunchOutcome import_only(const std::filesystem::path& scene) {
    return launch_on(std::nullopt, scene, "import_entry.py");
  }

  SceneSurvey survey(const std::filesystem::path& scene) {
    const LaunchOutcome outcome = launch(scene);
    if (const auto* failure = std::get_if<LaunchFailure>(&outcome)) {
      fail(ExitCode::tasks_failed, "{} {}", failure->message, failure->details);
    }
    return read_survey(last_folder_ / std::get<Finished>(outcome).result.at("survey").get<std::string>());
  }

  /// The folder of the last launch.
  [[nodiscard]] const std::filesystem::path& last_folder() const { return last_folder_; }

 private:
  LaunchOutcome launch_on(const std::optional<BlendPath>& blend, const std::filesystem::path& scene,
                          const std::string& entry) {
    Launch launch;
    launch.entry = entry;
    launch.scene = blend;
    launch.request = {{"scene", scene.string()}};
    launch.folder = folder_.path() / ("launch" + std::to_string(launches_++));
    std::filesystem::create_directory(launch.folder);
    last_folder_ = launch.folder;
    return blender_.run(launch, LaunchLimits{}, [](const ProgressEvent&) {});
  }

  const std::string scenes = RNMBAKE_SOURCE_DIR "/tests/with_blender/scenes/";
  TempFolder folder_;
  std::filesystem::path last_folder_;
  RealBlender blender_;
  int launches_ = 0;
};

inline const SceneObject* find_object(const SceneSurvey& survey, const std::string& key) {
  const auto found = std::find_if(survey.objects.begin(), survey.objects.end(),
                                  [&](const SceneObject& object) { return object.key == key; });
  return found == survey.objects.end() ? nullptr : &*found;
}

}  // namespace rnmbake
