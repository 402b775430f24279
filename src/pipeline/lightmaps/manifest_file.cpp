#include "pipeline/lightmaps/manifest_file.h"

#include "base/error.h"
#include "base/files.h"
#include "base/json.h"

namespace rnmbake {

using nlohmann::json;

nlohmann::json to_json(const std::vector<BasisDirection>& bases) {
  json list = json::array();
  for (const BasisDirection& basis : bases) {
    list.push_back(
        {{"name", basis.name}, {"direction", {basis.direction.x, basis.direction.y, basis.direction.z}}});
  }
  return list;
}

std::string object_key_of(const json& entry) {
  const auto key = entry.at("key").get<std::string>(), part = entry.at("part").get<std::string>();
  return part.empty() ? key : key.substr(0, key.size() - part.size() - 1);
}

nlohmann::json read_manifest(const std::filesystem::path& file) {
  json manifest = parse_json(read_text(file), file.string());
  const auto version = manifest.find("schema_version");
  if (version == manifest.end() || !version->is_number_integer()) {
    fail(ExitCode::invalid_input, "{}: is no manifest (no schema_version); name a folder that rnmbake wrote",
         file.string());
  }
  if (*version != manifest_schema_version) {
    fail(ExitCode::unsupported,
         "{}: schema_version is {}, this rnmbake reads {}; use the rnmbake that wrote it", file.string(),
         brief(*version), manifest_schema_version);
  }
  return manifest;
}

}  // namespace rnmbake
