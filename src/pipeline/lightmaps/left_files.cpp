#include "pipeline/lightmaps/left_files.h"

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/json.h"
#include "base/read_file.h"
#include "pipeline/lightmaps/manifest_file.h"

#include <map>
#include <optional>
#include <set>
#include <system_error>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Name in the folder -> hash of what was baked; "" where the manifest has none.
using Files = std::map<std::string, std::string>;

fs::path list_in(const fs::path& dir) {
  return dir / ".rnmbake-left.json";
}

Files read_list(const fs::path& dir) {
  Files files;
  const json list = fs::is_regular_file(list_in(dir)) ? json_or_null(read_text(list_in(dir))) : json();
  try {
    for (const json& one : list) files[one.at(0).get<std::string>()] = one.at(1).get<std::string>();
  } catch (const json::exception&) {
    return {};  // not ours, or cut off
  }
  return files;
}

void write_list(const fs::path& dir, const Files& files) {
  if (files.empty()) {
    fs::remove(list_in(dir));
    return;
  }
  json list = json::array();
  for (const auto& [name, hash] : files) list.push_back({name, hash});
  write_atomically(list_in(dir), list.dump() + "\n");
}

Files files_of(const json& entry) {
  Files files;
  const json hashes = entry.value("hashes", json::array());
  for (std::size_t i = 0; i < entry.at("files").size(); ++i)
    files[entry["files"][i].get<std::string>()] = i < hashes.size() ? hashes[i].get<std::string>() : "";
  return files;
}

Files files_of_all(const json& manifest) {
  Files all;
  for (const json& entry : manifest.at("objects")) all.merge(files_of(entry));
  return all;
}

/// Files that `before` lists for objects that are not in the scene, or have other lightmaps now.
Files dropped(const json& before, const json& now, const SceneSurvey& survey) {
  std::set<std::string> in_scene, baked;
  for (const SceneObject& object : survey.objects) in_scene.insert(object.key);
  for (const json& entry : now.at("objects")) {
    if (entry.at("status") == "baked") baked.insert(object_key_of(entry));
  }
  Files files;
  for (const json& entry : before.at("objects")) {
    const std::string object = object_key_of(entry);
    if (!in_scene.contains(object) || baked.contains(object)) files.merge(files_of(entry));
  }
  return files;
}

/// The file, where it lies in the folder and is no link out of it.
std::optional<fs::path> find(const fs::path& dir, const std::string& name) {
  auto inside = file_inside(dir, name);
  if (!inside || !fs::is_regular_file(fs::symlink_status(*inside))) return std::nullopt;
  return inside;
}

}  // namespace

void note_left_files(const fs::path& dir, const json& before, const json& now, const SceneSurvey& survey) {
  Files files = read_list(dir);
  try {
    if (!before.is_null()) files.merge(dropped(before, now, survey));
  } catch (const json::exception&) {
    // is no manifest: what it may have listed is not known
  }
  const Files listed = files_of_all(now);
  std::erase_if(files,
                [&](const auto& file) { return listed.contains(file.first) || !find(dir, file.first); });
  write_list(dir, files);
}

Pruned prune_left_files(const fs::path& dir) {
  Files files = read_list(dir);
  if (files.empty()) return {};
  const Files listed = files_of_all(read_manifest(dir / "manifest.json"));
  Pruned pruned;
  std::erase_if(files, [&](const auto& file) {
    const auto& [name, hash] = file;
    const auto path = find(dir, name);
    if (!path || listed.contains(name)) return true;
    if (file_hash128_hex(*path) != hash) {
      pruned.changed.push_back(name);
      return false;
    }
    std::error_code error;
    if (!fs::remove(*path, error) && error)
      fail(ExitCode::io, "{}: cannot be deleted: {}; delete it, or let it be written to", path->string(),
           error.message());
    pruned.removed.push_back(name);
    return true;
  });
  write_list(dir, files);
  return pruned;
}

}  // namespace rnmbake
