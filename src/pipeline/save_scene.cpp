#include "pipeline/save_scene.h"

#include "base/error.h"
#include "base/log.h"
#include "pipeline/scene_survey.h"

#include <fstream>
#include <set>
#include <span>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

void write_uvs(const fs::path& file, const std::vector<Vec2>& uv) {
  const auto bytes = std::as_bytes(std::span(uv));
  write_atomically(file, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

bool wanted(OutputSettings::SaveScene mode, bool any_unwrapped) {
  using Mode = OutputSettings::SaveScene;
  return mode == Mode::always || (mode == Mode::when_unwrapped && any_unwrapped);
}

}  // namespace

std::string save_scene_with_uvs(Workspace& workspace, const Survey& survey, const fs::path& blend,
                                const std::vector<Target>& targets) {
  Launch launch;
  launch.entry = "save_uvs_entry.py";
  if (blend.extension() == ".blend") launch.scene = blend;  // glTF is imported by the script
  launch.request = scene_request(workspace, blend);
  launch.request["objects"] = nlohmann::json::array();
  launch.folder = workspace.new_folder("save-uvs");
  std::set<std::size_t> done;  // parts of one object share their UVs
  for (const Target& target : targets) {
    if (!target.unwrapped || !done.insert(target.object).second) continue;
    const SceneObject& object = survey.objects[target.object];
    const std::string array = "uv" + std::to_string(target.object) + ".f32";
    write_uvs(launch.folder / array, *target.uv);
    launch.request["objects"].push_back({{"key", object.key}, {"name", object.name}, {"uv_array", array}});
  }
  const OutputSettings& output = workspace.settings().output;
  if (!wanted(output.save_scene, !done.empty())) return "";

  const fs::path folder = launch.folder;
  const auto answer = workspace.run(std::move(launch));
  for (const auto& key : answer.at("realized")) {
    log::info(
        "{}: a plain mesh in the saved scene, since its UVs belong to what its modifiers or instancer make",
        key.get<std::string>());
  }
  std::string name = workspace.settings().scene.file.stem().string() + ".lightmap-uvs.blend";
  write_atomically(output.dir / name, [&](const fs::path& temporary) {
    fs::copy_file(folder / answer.at("blend").get<std::string>(), temporary,
                  fs::copy_options::overwrite_existing);
  });
  return name;
}

}  // namespace rnmbake
