#include "pipeline/local/local_targets.h"

#include "base/files.h"
#include "base/hash.h"
#include "base/json.h"
#include "base/log.h"
#include "base/object_notes.h"
#include "base/read_file.h"
#include "base/text.h"
#include "pipeline/lightmaps/left_files.h"
#include "pipeline/lightmaps/manifest_file.h"
#include "scene/scene_places.h"

#include <algorithm>
#include <map>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* mark = "assumed_local";

/// Whether the files of a manifest's entry are those that were baked.
bool is_whole(const json& entry, const fs::path& dir) {
  if (entry.at("status") != "baked") return false;
  const json& files = entry.at("files");
  const json hashes = entry.value("hashes", json::array());
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto inside = file_inside(dir, files[i].get<std::string>());
    if (!inside || !fs::is_regular_file(*inside) || i >= hashes.size()) return false;
    if (file_hash128_hex(*inside) != hashes[i].get<std::string>()) return false;
  }
  return true;
}

/// Keys of lightmaps that the folder holds as its manifest says.
std::set<std::string> whole_lightmaps(const fs::path& dir) {
  std::set<std::string> keys;
  const fs::path file = dir / "manifest.json";
  if (!fs::is_regular_file(file)) return keys;
  const json manifest = json_or_null(read_text(file));
  try {
    for (const json& entry : manifest.at("objects")) {
      if (is_whole(entry, dir)) keys.insert(entry.at("key").get<std::string>());
    }
  } catch (const json::exception&) {
    return {};
  }
  return keys;
}

TargetList without(const TargetList& all, const std::set<std::string>& keys) {
  TargetList list{{}, {}, all.skipped};
  for (std::size_t i = 0; i < all.targets.size(); ++i) {
    if (keys.contains(all.targets[i].key)) continue;
    list.targets.push_back(all.targets[i]);
    list.settings.push_back(all.settings[i]);
  }
  return list;
}

void say_all(const std::string& why) {
  log::info("--assume-local: everything is baked, since {}", why);
}

/// Objects of the scene that no change reaches.
std::set<std::size_t> untouched(const PlacedScene& scene, const PlacedChanges& changes, double metres) {
  std::set<std::size_t> objects;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (!changes.reach(scene.objects[i].box, metres)) objects.insert(i);
  }
  return objects;
}

}  // namespace

LocalRule::Assumption LocalRule::assume(const SceneSurvey& survey, const TargetList& all) const {
  if (!metres_) return {};
  if (const std::string why = last_.other_than_scene(); !why.empty()) {
    say_all(why);
    return {};
  }
  const auto before = last_.scene();
  if (!before || survey.digest.empty()) {
    say_all("nothing is known of the scene that was baked before");
    return {};
  }
  const PlacedScene now = place_scene(survey);
  const PlacedChanges changes = placed_changes(*before, now);
  if (!changes.everywhere.empty()) {
    say_all(fmt::format("{} changed, whose light may reach everything", first_names(changes.everywhere)));
    return {};
  }
  const std::set<std::size_t> objects = untouched(now, changes, *metres_);
  const std::set<std::string> whole = whole_lightmaps(dir_);
  std::set<std::size_t> incomplete;  // objects, one of whose parts has no lightmap
  for (const Target& target : all.targets) {
    if (!whole.contains(target.key)) incomplete.insert(target.object);
  }
  Assumption assumption{{}, !changes.empty()};
  for (const Target& target : all.targets) {
    if (objects.contains(target.object) && !incomplete.contains(target.object))
      assumption.keys.insert(target.key);
  }
  return assumption;
}

TargetList LocalRule::preview(const SceneSurvey& survey, const TargetList& all) const {
  return without(all, assume(survey, all).keys);
}

LocalTargets LocalRule::choose(const SceneSurvey& survey, const TargetList& all,
                               const FindEarlier& find) const {
  Assumption assumption = assume(survey, all);
  LocalTargets local{without(all, assumption.keys), {}, 0};
  local.earlier = find(local.list.targets);
  std::set<std::string> kept;
  for (const EarlierLightmap& one : local.earlier.kept) kept.insert(one.entry.at("key").get<std::string>());
  if (!std::ranges::includes(kept, assumption.keys)) {  // their UVs are lost, say: a warning named them
    std::erase_if(assumption.keys, [&](const std::string& key) { return !kept.contains(key); });
    local.list = without(all, assumption.keys);
    local.earlier = find(local.list.targets);
  }
  for (EarlierLightmap& one : local.earlier.kept) {
    if (!assumption.keys.contains(one.entry.at("key").get<std::string>())) continue;
    if (assumption.has_changes) one.entry[mark] = true;
    if (one.entry.contains(mark)) ++local.assumed;
  }
  if (!assumption.keys.empty())
    log::info("{} of {} stay: assumed to be as they were, more than {} from every change",
              assumption.keys.size(), counted(all.targets.size(), "lightmap"), *metres_);
  return local;
}

void keep_all(const fs::path& dir, const SceneSurvey& survey, const EarlierLightmaps& earlier) {
  json now = read_manifest(dir / "manifest.json");
  const json before = now;
  std::map<std::string, json> entries;
  for (const EarlierLightmap& one : earlier.kept) entries[one.entry.at("key").get<std::string>()] = one.entry;
  json objects = json::array();
  for (json entry : before.at("objects")) {
    const auto found = entries.find(entry.at("key").get<std::string>());
    if (found == entries.end()) continue;
    if (found->second.contains(mark)) entry[mark] = true;
    objects.push_back(std::move(entry));
  }
  now["objects"] = std::move(objects);
  write_atomically(dir / "manifest.json", now.dump(2) + "\n");
  note_left_files(dir, before, now, survey);
}

}  // namespace rnmbake
