// pipeline/lightmaps/lightmap_place.h - where the lightmap of one object lies.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

/// One object's lightmap, not read yet.
struct LightmapPlace {
  std::string key;
  std::vector<std::filesystem::path> files;  // one, or one for each layer
  std::vector<std::string> outside_model;    // not traced by a reference: "glossy", ...
};

/// As manifests and reports name them: without their folder.
[[nodiscard]] inline std::vector<std::string> file_names(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> names;
  names.reserve(files.size());
  for (const std::filesystem::path& file : files) names.push_back(file.filename().string());
  return names;
}

}  // namespace rnmbake
