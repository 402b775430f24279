// cli/bases/basis_file.h - the directions to bake for, out of RNM's or of a list in TOML.
#pragma once

#include "config/bake_settings.h"
#include "encoding/basis_set.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

struct BasisFile {
  BasisSet set;                       // named after the file
  std::vector<std::string> warnings;  // from check_basis()
};

/// Reads `[[basis]]` tables, each with `name = "..."` and `direction = [x, y, z]` (tangent space, unit
/// length). Throws Error(io) where the file cannot be read and Error(invalid_input), with the line, where it
/// does not parse, holds another key or a direction that check_basis() rejects.
[[nodiscard]] BasisFile read_basis_file(const std::filesystem::path& file);

/// Its directions; logs the warnings.
[[nodiscard]] BasisSet read_basis_set(const std::filesystem::path& file);

/// The directions that --bases and --basis choose. Logs a file's warnings. Throws as read_basis_file(), and
/// Error(usage) where the file does not have a name.
[[nodiscard]] std::vector<BasisDirection> choose_bases(const BakingSettings& settings);

}  // namespace rnmbake
