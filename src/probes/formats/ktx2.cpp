#include "probes/formats/ktx2.h"

#include "base/version.h"
#include "probes/formats/makers.h"

namespace rnmbake {
namespace {

constexpr std::uint32_t rgba16_sfloat = 97;  // VkFormat
constexpr std::uint32_t texel_bytes = 8;

std::string data_format_descriptor() {
  constexpr std::uint32_t channels = 4, block_bytes = 24 + 16 * channels;
  std::string bytes;
  append_u32(bytes, 4 + block_bytes);
  append_u32(bytes, 0);                        // Khronos' basic descriptor
  append_u32(bytes, 2U | block_bytes << 16U);  // its version 2
  bytes += {1, 1, 1, 0};                       // RGBSDA, BT.709, linear, alpha not multiplied
  bytes += std::string(4, '\0');               // blocks of 1 x 1 x 1 x 1
  bytes += {texel_bytes, 0, 0, 0, 0, 0, 0, 0};
  constexpr std::array<std::uint32_t, channels> ids{0, 1, 2, 15};  // red, green, blue, alpha
  constexpr std::uint32_t is_float = 0x80, is_signed = 0x40, last_bit = 15;
  for (std::uint32_t channel = 0; channel < channels; ++channel) {
    append_u32(bytes, 16 * channel | last_bit << 16U | (ids[channel] | is_float | is_signed) << 24U);
    append_u32(bytes, 0);
    append_float(bytes, -1);
    append_float(bytes, 1);
  }
  return bytes;
}

void pad(std::string& bytes, std::size_t multiple) {
  bytes.resize((bytes.size() + multiple - 1) / multiple * multiple, '\0');
}

std::string key_values() {
  std::string entry = "KTXwriter";
  entry.push_back('\0');
  entry += std::string("rnmbake ") + version;
  entry.push_back('\0');
  std::string bytes;
  append_u32(bytes, static_cast<std::uint32_t>(entry.size()));
  bytes += entry;
  pad(bytes, 4);
  return bytes;
}

}  // namespace

std::string ktx2_of_halves(const std::array<std::uint32_t, 3>& size, const std::string& texels) {
  const std::string descriptor = data_format_descriptor(), values = key_values();
  constexpr std::uint32_t header_bytes = 80, level_index_bytes = 24;
  const std::uint32_t descriptor_at = header_bytes + level_index_bytes;
  const auto values_at = descriptor_at + static_cast<std::uint32_t>(descriptor.size());

  std::string bytes("\xABKTX 20\xBB\r\n\x1A\n", 12);
  append_u32(bytes, rgba16_sfloat);
  append_u32(bytes, 2);  // bytes of one number
  for (const std::uint32_t side : size) append_u32(bytes, side);
  append_u32(bytes, 0);  // no array
  append_u32(bytes, 1);  // faces
  append_u32(bytes, 1);  // levels
  append_u32(bytes, 0);  // no supercompression
  append_u32(bytes, descriptor_at);
  append_u32(bytes, static_cast<std::uint32_t>(descriptor.size()));
  append_u32(bytes, values_at);
  append_u32(bytes, static_cast<std::uint32_t>(values.size()));
  append_u64(bytes, 0);  // no data of a supercompression
  append_u64(bytes, 0);

  std::string front(descriptor + values);
  const std::size_t front_at = bytes.size() + level_index_bytes;
  front.resize((front_at + front.size() + texel_bytes - 1) / texel_bytes * texel_bytes - front_at, '\0');
  append_u64(bytes, front_at + front.size());
  append_u64(bytes, texels.size());
  append_u64(bytes, texels.size());
  return bytes + front + texels;
}

}  // namespace rnmbake
