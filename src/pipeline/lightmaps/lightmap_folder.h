// pipeline/lightmaps/lightmap_folder.h - lightmaps found on disk: a folder with a manifest, or a single file.
#pragma once

#include "image/layered_exr.h"
#include "lightmap/metadata.h"
#include "pipeline/lightmaps/lightmap_place.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

struct LightmapFolder {
  std::filesystem::path path;
  bool single_file = false;           // `path` is a lightmap itself, under the key of its header
  std::vector<LightmapPlace> places;  // in the manifest's order
  std::vector<std::string> failed;    // keys of objects that were not baked
  std::vector<std::string> notes;     // warnings of the scene; lamps and world that could not be traced

  [[nodiscard]] const LightmapPlace* find(const std::string& key) const;
};

/// Throws Error(io) where there is nothing to read, Error(invalid_input) where it is no output of rnmbake.
[[nodiscard]] LightmapFolder open_lightmaps(const std::filesystem::path& path);

struct LoadedLightmap {
  std::string file;    // the first one's name, for messages
  LayeredImage image;  // all layers; the flat bake under the name ""
  LightmapMetadata metadata;
};

/// Throws Error(io), or Error(invalid_input) where a file is damaged or no lightmap, or files of one object
/// differ in size.
[[nodiscard]] LoadedLightmap load_lightmap(const LightmapPlace& place);

}  // namespace rnmbake
