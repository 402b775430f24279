#include "encoding/codecs/describe_codec.h"

#include <spdlog/fmt/fmt.h>

namespace rnmbake {

std::string label_of(const CodecOptions& codec) {
  std::string label = codec.name;
  if (codec.range > 0) label += fmt::format(" K={:g}", codec.range);
  if (codec.bits > 0) label += fmt::format(", {} bits", codec.bits);
  if (codec.mono) label += ", mono";
  return label;
}

int stored_bytes(const CodecOptions& codec, std::size_t layers) {
  constexpr int half_colour = 6;
  if (codec.bits == 0) return static_cast<int>(layers) * half_colour;
  return half_colour + static_cast<int>(layers - 1) * 3 * codec.bits / 8;
}

}  // namespace rnmbake
