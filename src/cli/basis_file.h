// cli/basis_file.h - reads a list of directions to bake for from TOML.
#pragma once

#include "basis/basis_set.h"

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

}  // namespace rnmbake
