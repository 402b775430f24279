// ssbump/map/direction_map.h - a self-shadowed bump map of any set of directions, to and from its file.
#pragma once

#include "encoding/basis_set.h"
#include "image/float_image.h"
#include "image/picture_rows.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace rnmbake {

struct DirectionMapMetadata {
  BasisSet set;
  std::string fit, method, settings;  // how the weights were found, in words
};

struct DirectionMap {
  DirectionMapMetadata metadata;
  FloatImage weights;   // s_i, one channel for each direction in the set's order
  std::string storage;  // "half", "float"
};

/// One channel for each direction, under its name. The header names the set and holds its vectors under the
/// attributes that lightmaps have (lightmap/metadata.h): right-handed, y up.
[[nodiscard]] PictureForm direction_map_form(const DirectionMapMetadata& metadata, int width, int height,
                                             Storage storage);

/// Whether these are the attributes of such a map.
[[nodiscard]] bool is_direction_map(const std::map<std::string, Attribute>& attributes);

/// Nothing where the file is none. Throws Error(invalid_input) where the header contradicts the channels or a
/// weight is not finite, and as PictureReader.
[[nodiscard]] std::optional<DirectionMap> read_direction_map(const std::filesystem::path& file);

}  // namespace rnmbake
