#include "pipeline/scene/save_scene.h"

#include "base/bytes.h"
#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "pipeline/scene/scene_survey.h"

#include <algorithm>
#include <set>
namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

bool wanted(OutputSettings::SaveScene mode, const std::vector<SavedUvs>& objects) {
  using Mode = OutputSettings::SaveScene;
  const bool unwrapped = std::ranges::any_of(objects, [](const SavedUvs& one) { return one.uv != nullptr; });
  return mode == Mode::always || (mode == Mode::when_unwrapped && unwrapped);
}

/// The request's entries; writes the arrays that they name, each once.
class ObjectList {
 public:
  ObjectList(const SceneSurvey& survey, fs::path folder) : survey_(survey), folder_(std::move(folder)) {}

  void add(const SavedUvs& one) {
    const SceneObject& object = survey_.objects[one.object];
    json entry{{"key", object.key}, {"uv_layer", one.layer}, {"faces", faces_of(object.mesh)}};
    if (one.uv) entry["uv_array"] = array_of(one.uv);
    list.push_back(std::move(entry));
  }

  json list = json::array();

 private:
  std::string faces_of(int mesh) {
    std::string name = "faces" + std::to_string(mesh) + ".i32";
    if (faces_.insert(mesh).second) {
      const Mesh& it = survey_.meshes[static_cast<std::size_t>(mesh)];
      write_atomically(folder_ / name,
                       std::string(bytes_of(it.loop_vertex)) + std::string(bytes_of(it.polygon_start)));
    }
    return name;
  }

  std::string array_of(const Uvs& uv) {
    const auto [entry, fresh] = arrays_.emplace(uv.get(), "uv" + std::to_string(arrays_.size()) + ".f32");
    if (fresh) write_atomically(folder_ / entry->second, bytes_of(*uv));
    return entry->second;
  }

  const SceneSurvey& survey_;
  fs::path folder_;
  std::set<int> faces_;
  std::map<const void*, std::string> arrays_;
};

SavedScene read_answer(const json& answer, const SceneSurvey& survey, const std::vector<SavedUvs>& objects) {
  SavedScene saved;
  for (const SavedUvs& one : objects) {
    const std::string& key = survey.objects[one.object].key;
    const json& place = answer.at("objects").at(key);
    saved.objects[one.object] = {place.at("object").get<std::string>(), place.at("uv_index").get<int>()};
    if (place.at("plain").get<bool>()) {
      log::info(
          "{}: a plain mesh in the saved scene, since its UVs belong to what its modifiers or instancer make",
          key);
    }
  }
  return saved;
}

}  // namespace

std::vector<SavedUvs> uvs_of(const std::vector<Target>& targets) {
  std::vector<SavedUvs> objects;
  std::set<std::size_t> done;  // parts of one object share their UVs
  for (const Target& target : targets) {
    if (done.insert(target.object).second)
      objects.push_back({target.object, target.uv_layer, target.unwrapped ? target.uv : nullptr});
  }
  return objects;
}

SavedScene save_scene_with_uvs(BlenderSession& session, const SceneSurvey& survey, const BlendPath& own,
                               const std::vector<SavedUvs>& objects) {
  const BakeSettings& settings = session.settings();
  if (!wanted(settings.output.save_scene, objects)) return {};
  Launch launch = launch_on(session, "save_uvs_entry.py", "save-uvs", own);
  launch.request["imported"] = !is_blend(settings.scene.file);
  ObjectList list(survey, launch.folder);
  for (const SavedUvs& one : objects) list.add(one);
  launch.request["objects"] = std::move(list.list);

  const std::string name = settings.scene.file.stem().string() + ".lightmap-uvs.blend";
  SavedScene saved;
  write_atomically(fs::absolute(settings.output.dir) / name, [&](const fs::path& temporary) {
    launch.save_as = temporary;
    saved = read_answer(session.run(std::move(launch)), survey, objects);
  });
  saved.file = name;
  return saved;
}

}  // namespace rnmbake
