#include "pipeline/scene/export_scene.h"

#include "base/error.h"
#include "base/log.h"
#include "pipeline/scene/kept_scene.h"
#include "pipeline/scene/launch_answer.h"

#include <algorithm>
#include <map>
#include <utility>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

/// An exported scene is one moment of one view layer with its light, and holds no other.
void refuse_choice(const SceneSettings& scene) {
  const SceneSettings none;
  const char* chosen = scene.scene != none.scene             ? "--scene"
                       : scene.view_layer != none.view_layer ? "--view-layer"
                       : scene.frame != none.frame           ? "--frame"
                       : scene.sky != none.sky               ? "--sky"
                       : scene.sun != none.sun               ? "--sun"
                                                             : nullptr;
  if (chosen == nullptr) return;
  fail(ExitCode::usage,
       "{}: {} is for a .blend or glTF, and this is an exported scene; give it to rnmbake export",
       scene.file.string(), chosen);
}

/// Launches the export of a lambert scene.
DiffuseScene launch_export(BlenderSession& session, const BlendPath& lambert) {
  const Launch launch = launch_on(session, "export_entry.py", "export", lambert);
  const nlohmann::json answer = session.run(launch);
  return read_exported(answered_file(answer, "survey", launch.folder));
}

void set_layer(Mesh& mesh, const std::string& name, const std::vector<Vec2>& uv) {
  const auto found = std::find_if(mesh.uv_layers.begin(), mesh.uv_layers.end(),
                                  [&](const UvLayer& layer) { return layer.name == name; });
  if (found != mesh.uv_layers.end()) {
    found->uv = uv;
  } else {
    mesh.uv_layers.push_back({name, uv});
  }
}

/// Adds unwrapped UVs to their meshes as a layer. Objects that share a mesh at different scales have
/// different UVs, and get meshes of their own.
void keep_unwrapped(SceneSurvey& survey, const std::vector<Target>& targets) {
  std::map<std::size_t, const Target*> by_object;  // parts of an object share their UVs
  for (const Target& target : targets) {
    if (target.unwrapped) by_object.emplace(target.object, &target);
  }
  std::map<std::pair<int, const void*>, int> made;  // mesh as it was, UVs -> mesh that has them
  std::vector<bool> taken(survey.meshes.size());
  for (const auto& [number, target] : by_object) {
    SceneObject& object = survey.objects[number];
    const auto original = static_cast<std::size_t>(object.mesh);
    const auto [entry, fresh] = made.emplace(std::pair(object.mesh, target->uv.get()), object.mesh);
    if (fresh && taken[original]) {
      entry->second = static_cast<int>(survey.meshes.size());
      survey.meshes.push_back(survey.meshes[original]);
    }
    taken[original] = true;
    object.mesh = entry->second;
    if (fresh) set_layer(survey.meshes[static_cast<std::size_t>(object.mesh)], target->uv_layer, *target->uv);
  }
}

DiffuseScene exported_before(const BlenderSession& session) {
  const fs::path file = session.settings().scene.file;
  refuse_choice(session.settings().scene);
  DiffuseScene scene = read_diffuse_scene(file);
  put_inputs_first(scene.survey, {{"scene", fs::absolute(file).lexically_normal(), true}});
  log_warnings(scene.survey);
  return scene;
}

ExportedScene exported_by_blender(BlenderSession& session, bool anew) {
  const fs::path file = session.settings().scene.file;
  KeptScene kept(session, anew);
  if (auto found = kept.find()) {
    log::info("{}: unchanged since it was exported", file.filename().string());
    log_warnings(found->diffuse_scene.survey);
    return std::move(*found);
  }
  ImportedScene own = import_scene(session, file);
  LambertScene lambert = make_lambert_scene(session, own.blend);
  log::info("writing down the scene for the tracer");
  ExportedScene result{launch_export(session, lambert.blend), {lambert.blend, own.blend}};
  SceneSurvey& survey = result.diffuse_scene.survey;
  survey.scene_file = file.string();
  survey.digest = std::move(lambert.digest);
  add_inputs(own.inputs, lambert.inputs);
  put_inputs_first(survey, std::move(own.inputs));
  log_warnings(survey, lambert.warnings);
  kept.keep(result);
  return result;
}

}  // namespace

bool is_rnmscene(const fs::path& file) {
  return file.extension() == diffuse_scene_ending;
}

ExportResult export_surfaces(BlenderSession& session, bool anew) {
  const fs::path file = session.settings().scene.file;
  ExportResult result;
  if (is_rnmscene(file)) {
    result.diffuse_scene = exported_before(session);
  } else {
    ExportedScene exported = exported_by_blender(session, anew);
    result.diffuse_scene = std::move(exported.diffuse_scene);
    result.blends = std::move(exported.blends);
  }
  if (result.diffuse_scene.survey.objects.empty()) {
    fail(ExitCode::invalid_input,
         "{}: nothing in this scene renders as a surface: is everything hidden from rendering?",
         file.string());
  }
  result.content = light_hash(result.diffuse_scene);
  return result;
}

ExportResult export_scene(BlenderSession& session, bool anew) {
  ExportResult result = export_surfaces(session, anew);
  result.list = make_targets(session.config(), result.diffuse_scene.survey);
  keep_unwrapped(result.diffuse_scene.survey, result.list.targets);
  return result;
}

}  // namespace rnmbake
