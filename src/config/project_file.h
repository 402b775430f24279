// config/project_file.h - reads a project file (TOML) into values that know their line.
#pragma once

#include "config/given.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace rnmbake {

struct ProjectFile {
  std::filesystem::path file;
  std::vector<SettingOverride> values;
  std::vector<ObjectOverride> overrides;  // in the file's order
};

/// Throws Error(io) where the file cannot be read and Error(usage) "project.toml:7: ..." where it is not
/// TOML, holds a table or key that does not exist, or a value that does not fit.
[[nodiscard]] ProjectFile read_project(const std::filesystem::path& file);

/// The same from text; `file` names it in messages and its folder is what relative paths start from.
[[nodiscard]] ProjectFile parse_project(std::string_view text, const std::filesystem::path& file);

}  // namespace rnmbake
