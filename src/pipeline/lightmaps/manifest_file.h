// pipeline/lightmaps/manifest_file.h - reads a manifest.json and holds it against its form.
#pragma once

#include "encoding/basis_set.h"

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// Raised when a reader of the old form would misunderstand the new one.
inline constexpr int manifest_schema_version = 1;

/// Throws Error(invalid_input) naming the file where it is no manifest, Error(unsupported) where it has
/// another schema version.
[[nodiscard]] nlohmann::json read_manifest(const std::filesystem::path& file);

/// Key of the object, for an entry of "objects" that may be of a part of it.
[[nodiscard]] std::string object_key_of(const nlohmann::json& entry);

/// The entry "bases".
[[nodiscard]] nlohmann::json to_json(const std::vector<BasisDirection>& bases);

}  // namespace rnmbake
