#include "pipeline/scene/kept_scene.h"

#include "base/bytes.h"
#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/json.h"
#include "base/read_file.h"
#include "blender/scripts.h"
#include "jobs/run_record.h"
#include "pipeline/run/result_store.h"
#include "scene/survey_parse.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t most_bytes = std::size_t{1} << 30;  // an entry is read and written in one piece

/// Lengths of an entry's parts: description, .rnmscene, lambert scene, imported scene (0: none).
using Lengths = std::array<std::uint64_t, 4>;

ResultKey key_of(const BlenderSession& session) {
  const BakeSettings& settings = session.settings();
  const BlenderInfo& blender = session.blender().info();
  KeyMaker key;
  key.add("file", file_hash128_hex(settings.scene.file));
  key.add("ending", settings.scene.file.extension().string());
  key.add("scene", settings.scene.scene).add("view layer", settings.scene.view_layer);
  key.add("frame", std::int64_t{settings.scene.frame});
  key.add("sky", settings.scene.sky).add("sun", settings.scene.sun);
  key.add("blender", blender.version_text).add("build", blender.build);
  key.add("scripts", scripts_hash(settings.run.scripts)).add("program", program_hash());
  return key.make("scene");
}

/// Where a folder of the session lies: relative paths of the lambert scene lead from there to its pictures.
std::string place_of(const fs::path& folder) {
  return folder.parent_path().parent_path().string();
}

json files_read(const SceneSurvey& survey, const fs::path& scene) {
  json files = json::array();
  for (const InputFile& input : survey.inputs) {
    if (input.path == fs::absolute(scene).lexically_normal()) continue;  // its content is in the key
    files.push_back({{"kind", input.kind},
                     {"path", input.path.string()},
                     {"there", input.was_there},
                     {"hash", look_at(input.kind, input.path).hash}});
  }
  return files;
}

bool is_as_it_was(const json& file) {
  return look_at("", file.at("path").get<std::string>()).hash == file.at("hash").get<std::string>();
}

/// An entry's parts; nothing where it is none.
std::optional<std::array<std::string_view, 4>> parts_of(std::string_view bytes) {
  ByteReader in(bytes);
  Lengths lengths{};
  std::array<std::string_view, 4> parts;
  if (!in.take(lengths)) return std::nullopt;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto part = in.cut(lengths[i]);
    if (!part) return std::nullopt;
    parts[i] = *part;
  }
  return parts;
}

}  // namespace

KeptScene::KeptScene(BlenderSession& session, bool anew)
    : session_(session), store_(open_store(session.settings())), is_on_(false), anew_(anew) {
  const BakeSettings& settings = session.settings();
  is_on_ = store_.keeps() && !settings.scene.allow_scripts && !settings.run.sandbox;
  if (is_on_) key_ = key_of(session);
}

std::optional<ExportedScene> KeptScene::find() {
  if (!is_on_ || anew_) return std::nullopt;
  const auto bytes = store_.get(key_);
  const auto parts = bytes ? parts_of(*bytes) : std::nullopt;
  if (!parts) return std::nullopt;
  const auto& [description, scene, lambert, imported] = *parts;
  const json about = parse_json(description, "a kept scene");
  const fs::path folder = session_.new_folder("kept"), file = session_.settings().scene.file;
  const json& read = about.at("files");
  if (about.at("place") != place_of(folder) || about.at("scene") != fs::absolute(file).string() ||
      !std::ranges::all_of(read, is_as_it_was))
    return std::nullopt;
  const auto written = [&](const char* name, std::string_view content) {
    write_atomically(folder / name, content);
    return BlendPath(folder / name);
  };
  const BlendPath own = is_blend(file) ? BlendPath(file) : written("imported.blend", imported);
  ExportedScene found{parse_diffuse_scene({scene.begin(), scene.end()}, file.string()),
                      {written("lambert.blend", lambert), own}};
  SceneSurvey& survey = found.diffuse_scene.survey;
  survey.scene_file = file.string();
  survey.digest = read_digest(about.at("digest"));
  survey.inputs = {{"scene", fs::absolute(file).lexically_normal(), true}};
  add_inputs(survey.inputs, read_inputs(read));
  return found;
}

void KeptScene::keep(const ExportedScene& exported) {
  if (!is_on_) return;
  const SceneSurvey& survey = exported.diffuse_scene.survey;
  const fs::path file = session_.settings().scene.file;
  if (key_of(session_).digits != key_.digits) return;  // it changed while Blender read it
  const json about{{"place", place_of(exported.blends.shown.path().parent_path())},
                   {"scene", fs::absolute(file).string()},
                   {"files", files_read(survey, file)},
                   {"digest", to_json(survey.digest)}};
  const bool is_imported = !is_blend(file);
  const std::array<std::string, 4> parts{about.dump(), diffuse_scene_bytes(exported.diffuse_scene),
                                         read_data(exported.blends.shown.path()),
                                         is_imported ? read_data(exported.blends.own.path()) : std::string()};
  std::string bytes;
  for (const std::string& part : parts) put(bytes, std::uint64_t(part.size()));
  for (const std::string& part : parts) bytes += part;
  if (bytes.size() > most_bytes) return;
  store_.remove(key_);
  store_.put(key_, bytes);
}

}  // namespace rnmbake
