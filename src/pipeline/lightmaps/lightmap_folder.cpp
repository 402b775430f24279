#include "pipeline/lightmaps/lightmap_folder.h"

#include "base/error.h"
#include "base/json.h"
#include "base/read_file.h"
#include "pipeline/lightmaps/lightmap_rows.h"
#include "pipeline/lightmaps/manifest_file.h"

#include <algorithm>
#include <utility>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {
namespace {

using nlohmann::json;

[[noreturn]] void fail_manifest(const std::filesystem::path& file, const std::string& why) {
  fail(ExitCode::invalid_input, "{}: {}; name a folder that rnmbake wrote", file.string(), why);
}

/// Names from a manifest never lead out of its folder.
std::filesystem::path inside(const std::filesystem::path& manifest, const std::string& name) {
  const auto file = file_inside(manifest.parent_path(), name);
  if (!file) fail_manifest(manifest, fmt::format("{} is no plain file name", brief(json(name))));
  return *file;
}

LightmapPlace place_of(const std::filesystem::path& manifest, const json& entry) {
  LightmapPlace place;
  place.key = entry.at("key").get<std::string>();
  for (const json& name : entry.at("files")) place.files.push_back(inside(manifest, name.get<std::string>()));
  if (const auto found = entry.find("outside_model"); found != entry.end())
    place.outside_model = found->get<std::vector<std::string>>();
  return place;
}

/// Warnings, and lamps and world outside the model (objects carry lists of their own): "light 'Lamp': node
/// tree".
std::vector<std::string> notes_of(const json& manifest) {
  auto notes = manifest.value("warnings", std::vector<std::string>{});
  for (const json& outside : manifest.value("outside_model", json::array())) {
    const auto owner = outside.at("owner").get<std::string>();
    if (owner.starts_with("object ")) continue;
    notes.push_back(fmt::format("outside the reference's model: {}: {}", owner,
                                fmt::join(outside.at("what").get<std::vector<std::string>>(), ", ")));
  }
  return notes;
}

LightmapFolder read_folder(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "manifest.json";
  if (!std::filesystem::exists(file)) {
    fail(
        ExitCode::io,
        "{} has no manifest.json; name a folder that rnmbake bake or rnmbake reference finished, or one .exr",
        folder.string());
  }
  LightmapFolder found{folder, false, {}, {}, {}};
  try {
    const json manifest = read_manifest(file);
    found.notes = notes_of(manifest);
    for (const json& entry : manifest.at("objects")) {
      LightmapPlace place = place_of(file, entry);
      if (place.files.empty()) {
        found.failed.push_back(place.key);
        continue;
      }
      if (found.find(place.key) != nullptr)
        fail_manifest(file, fmt::format("'{}' is there twice", place.key));
      found.places.push_back(std::move(place));
    }
  } catch (const json::exception& problem) {
    fail_manifest(file, fmt::format("is no manifest ({})", brief(problem)));
  }
  return found;
}

}  // namespace

const LightmapPlace* LightmapFolder::find(const std::string& key) const {
  const auto found = std::ranges::find(places, key, &LightmapPlace::key);
  return found == places.end() ? nullptr : &*found;
}

LightmapFolder open_lightmaps(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) return read_folder(path);
  LightmapPlace place{path.stem().string(), {path}, {}};
  const LightmapRows lightmap(place);
  if (!lightmap.metadata().object.empty()) place.key = lightmap.metadata().object;
  return {path, true, {place}, {}, {}};
}

LoadedLightmap load_lightmap(const LightmapPlace& place) {
  LightmapRows rows(place);
  LoadedLightmap lightmap{rows.file(), rows.read(0, rows.height()), rows.metadata()};
  lightmap.image.attributes = rows.header().attributes;
  return lightmap;
}

}  // namespace rnmbake
