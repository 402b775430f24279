// pipeline/convert/convert.h - lightmaps turned into another encoding, a few rows at a time.
#pragma once

#include "base/numeric/stored_values.h"
#include "encoding/codec.h"
#include "lightmap/metadata.h"
#include "pipeline/lightmaps/lightmap_folder.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

struct ConvertOptions {
  CodecOptions codec;
  bool world = false;  // layers in world space, by the frames that a bake with --frames stores
  Depth depth = Depth::half;
  bool split = false;  // a file for each layer, for engines that know none: floor.l0.exr
};

/// Of covered texels, or of all where the lightmap does not say which are.
struct ConvertCounts {
  EncodeCounts encode;
  std::size_t beyond_half = 0;    // values clamped to the range of half floats
  std::size_t without_frame = 0;  // texels without a frame in a world-space lightmap: kept without direction

  ConvertCounts& operator+=(const ConvertCounts& other);
};

struct ConvertSummary {
  std::string key;
  std::vector<std::filesystem::path> files;  // one, or one for each layer
  ConvertCounts counts;
};

/// Why a lightmap of this header cannot feed another encoding; nothing where it can. What it can be turned
/// into is make_codec()'s to say.
[[nodiscard]] std::optional<std::string> convert_obstacle(const LightmapMetadata& metadata);

/// Writes `file` (.exr, whole or not at all; with `split` one beside it for each layer): the codec's layers,
/// and coverage and frames as they are. Baked maps are taken as they are; of a lightmap that was converted
/// before, what its own decoder returns for the directions that it was made from. `progress`: the share that
/// is done. Throws Error(unsupported), naming the lightmap, where there is an obstacle, make_codec() refuses
/// the directions, or world space was asked for and no frames are there; else as load_lightmap().
[[nodiscard]] ConvertSummary convert_lightmap(const LightmapPlace& place, const ConvertOptions& options,
                                              const std::filesystem::path& file,
                                              const std::function<void(double)>& progress = {});

/// Every lightmap of a folder, or the only one: into `folder`, which is made. The manifest of a folder is
/// written last, with the new files and conventions. Throws as open_lightmaps() and convert_lightmap(), and
/// Error(usage) where `folder` is the source itself.
[[nodiscard]] std::vector<ConvertSummary> convert_lightmaps(
    const std::filesystem::path& source, const ConvertOptions& options, const std::filesystem::path& folder,
    const std::function<void(double, std::string)>& progress = {});

}  // namespace rnmbake
