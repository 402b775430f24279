#include "closed_forms/workbench.h"

#include "base/error.h"
#include "blender/find.h"
#include "blender/real_blender.h"
#include "process/run.h"
#include "scene/survey_parse.h"

#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

void run_or_fail(Words argv) {
  ProcessOptions options;
  options.argv = std::move(argv);
  const ProcessResult result = run_process(options);
  if (!result.succeeded()) fail(ExitCode::tasks_failed, "{} failed: {}", options.argv[0], result.output);
}

}  // namespace

Baked::Baked(const fs::path& folder) {
  const auto manifest = nlohmann::json::parse(read_text(folder / "manifest.json"));
  for (const auto& object : manifest.at("objects"))
    files_[object.at("key").get<std::string>()] = folder / object.at("files").at(0).get<std::string>();
}

LayeredImage Baked::lightmap(const std::string& object) const {
  const auto found = files_.find(object);
  if (found == files_.end()) fail(ExitCode::tasks_failed, "'{}' was not baked", object);
  return read_image(found->second);
}

Workbench::Workbench(fs::path binary, const std::optional<std::string>& blender)
    : binary_(std::move(binary)), blender_(probe_version(find_blender(blender))) {}

fs::path Workbench::new_path(const std::string& name) {
  return folder_.path() / (name + std::to_string(count_++));
}

fs::path Workbench::build(const SceneChoice& scene) {
  fs::path blend = new_path(scene.name);
  blend += ".blend";
  Words argv{blender_.executable.string(),
             "-b",
             "--factory-startup",
             "-noaudio",
             "--python-exit-code",
             "86",
             "--python",
             RNMBAKE_SOURCE_DIR "/scenes/make.py",
             "--",
             scene.name,
             blend.string()};
  argv.insert(argv.end(), scene.parameters.begin(), scene.parameters.end());
  run_or_fail(argv);
  return blend;
}

Baked Workbench::bake(const fs::path& blend, const Words& flags) {
  return lightmaps("bake", blend, flags);
}

Baked Workbench::reference(const fs::path& scene, const Words& flags) {
  return lightmaps("reference", scene, flags);
}

Baked Workbench::lightmaps(const char* command, const fs::path& scene, const Words& flags) {
  const fs::path folder = new_path("baked");
  Words argv{binary_.string(),
             command,
             scene.string(),
             "-o",
             folder.string(),
             "--blender",
             blender_.executable.string(),
             "--depth",
             "float",
             "--dilate",
             "0",
             "--scripts",
             RNMBAKE_SOURCE_DIR "/blender_scripts"};
  argv.insert(argv.end(), flags.begin(), flags.end());
  run_or_fail(argv);
  return Baked(folder);
}

fs::path Workbench::exported(const fs::path& blend) {
  fs::path scene = new_path("exported");
  scene += ".rnmscene";
  run_or_fail({binary_.string(), "export", blend.string(), "-o", scene.string(), "--blender",
               blender_.executable.string(), "--scripts", RNMBAKE_SOURCE_DIR "/blender_scripts"});
  return scene;
}

SceneSurvey Workbench::survey(const fs::path& blend) {
  RealBlender::Options options;
  options.scripts = fs::path(RNMBAKE_SOURCE_DIR "/blender_scripts");
  RealBlender blender(blender_, options);
  Launch launch;
  launch.entry = "survey_entry.py";
  launch.scene = BlendPath(blend);
  launch.request = {{"scene", blend.string()}};
  launch.folder = new_path("survey");
  fs::create_directory(launch.folder);
  const LaunchOutcome outcome = blender.run(launch, LaunchLimits{}, [](const ProgressEvent&) {});
  if (const auto* failure = std::get_if<LaunchFailure>(&outcome))
    fail(ExitCode::tasks_failed, "{} {}", failure->message, failure->details);
  return read_survey(launch.folder / std::get<Finished>(outcome).result.at("survey").get<std::string>());
}

}  // namespace rnmbake
