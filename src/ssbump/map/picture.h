// ssbump/map/picture.h - a self-shadowed bump map read from its file, whatever its scale, handedness and
// depth.
#pragma once

#include "image/float_image.h"
#include "ssbump/map/files.h"
#include "ssbump/map/metadata.h"

#include <filesystem>
#include <optional>
#include <string>

namespace rnmbake {

/// User's statements on the encoding of a file without metadata.
struct SsbumpHints {
  std::optional<SsbumpScale> scale;
  std::optional<Handed> handed;
  std::optional<SsbumpAlpha> alpha;
};

struct SsbumpPicture {
  FloatImage weights;  // SsbumpWeights: five channels, right-handed, 1 is open; 1 where the file says nothing
  SsbumpMetadata metadata;
  bool knows_itself = false;  // whether the file has metadata
  std::string storage;        // "uint8", ...
};

/// Reads the encoding from the file's metadata, else from `told`, else takes scale third, right-handed, no
/// alpha, with a warning. Throws Error(usage) where `told` contradicts the file,
/// Error(unsupported) where it is a map of a set of directions (direction_map.h), Error(invalid_input) where
/// there are fewer than three channels or a value is not finite (naming the texel), and as PictureReader.
[[nodiscard]] SsbumpPicture read_ssbump(const std::filesystem::path& file, const SsbumpHints& hints);

/// Writes it whole, with `metadata` and what `output` says of encoding and storage.
void write_ssbump(const SsbumpOutput& output, const SsbumpMetadata& metadata, const FloatImage& weights);

/// The encoding that a picture came in.
[[nodiscard]] SsbumpEncoding encoding_of(const SsbumpMetadata& metadata);

}  // namespace rnmbake
