// probes/volume_file.h - volumes of light probes on disk: probes.json, and EXR slices for each volume.
#pragma once

#include "probes/probe_volume.h"

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// docs/probes.md describes the files. A volume's picture has one texel for each probe, slices of z one below
/// the other, row 0 at y = 0, z = 0; with a tree about as many rows as columns, filled row by row, and the
/// cells in a picture of their own (probes/tree_file.h). `about` becomes the key "about" of probes.json: how
/// the light was found. Returns the names of the files, probes.json last. Throws Error(io).
std::vector<std::string> write_volumes(const std::filesystem::path& folder,
                                       const std::vector<ProbeVolume>& volumes, const nlohmann::json& about);

struct StoredVolumes {
  std::vector<ProbeVolume> volumes;
  nlohmann::json about;
};

/// `path`: the folder or its probes.json. Throws Error(io) where a file cannot be read, and
/// Error(invalid_input), naming the file, where one is damaged, holds numbers that are none, or does not fit
/// the others.
[[nodiscard]] StoredVolumes read_volumes(const std::filesystem::path& path);

}  // namespace rnmbake
