// config/project_file.h - reads a project file (TOML) into values that know their line.
#pragma once

#include "config/given.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace rnmbake {

/// One [[scenes]] of a project file: what holds for that scene alone.
struct ProjectScene {
  std::filesystem::path file;  // .blend, .glb, .gltf
  std::vector<SettingOverride> values;
  std::vector<ObjectOverride> overrides;  // [[scenes.override]], after those of all scenes
};

struct ProjectFile {
  std::filesystem::path file;
  std::vector<SettingOverride> values;
  std::vector<ObjectOverride> overrides;  // in the file's order
  std::vector<ProjectScene> scenes = {};  // none: the one of [scene]

  /// The project as it holds for one scene of its list, which then has that scene alone.
  [[nodiscard]] ProjectFile of_scene(const ProjectScene& scene) const;
};

/// Throws Error(io) where the file cannot be read and Error(usage) "project.toml:7: ..." where it is not
/// TOML, holds a table or key that does not exist, or a value that does not fit.
[[nodiscard]] ProjectFile read_project(const std::filesystem::path& file);

/// The same from text; `file` names it in messages and its folder is what relative paths start from.
[[nodiscard]] ProjectFile parse_project(std::string_view text, const std::filesystem::path& file);

}  // namespace rnmbake
