// encoding/codecs/describe_codec.h - a codec in words, and what a texel of it takes.
#pragma once

#include "encoding/codec.h"

#include <cstddef>
#include <string>

namespace rnmbake {

/// "zh3 K=2, 8 bits, mono"
[[nodiscard]] std::string label_of(const CodecOptions& codec);

/// Bytes of a texel as engines store it: three half floats for each layer; packed directions by their bits.
/// `layers`: how many Codec::layers() are.
[[nodiscard]] int stored_bytes(const CodecOptions& codec, std::size_t layers);

}  // namespace rnmbake
