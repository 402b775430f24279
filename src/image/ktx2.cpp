#include "image/ktx2.h"

#include "base/bytes.h"
#include "base/error.h"
#include "base/version.h"

#include <bit>
#include <cstddef>

#include <zstd.h>

namespace rnmbake {
namespace {

/// Some bits of a texel or block, as a data format descriptor knows them.
struct Sample {
  std::uint32_t first_bit = 0, bits = 0, channel = 0;
  std::uint32_t lower = 0, upper = 0;
};

constexpr std::uint32_t is_float = 0x80, is_signed = 0x40, is_exponent = 0x20;  // beside the channel
constexpr std::uint32_t alpha = 15;

constexpr Sample float_sample(std::uint32_t first_bit, std::uint32_t bits, std::uint32_t channel,
                              bool with_sign) {
  return {first_bit, bits, channel | is_float | (with_sign ? is_signed : 0),
          std::bit_cast<std::uint32_t>(with_sign ? -1.0F : 0.0F), std::bit_cast<std::uint32_t>(1.0F)};
}

struct Description {
  std::uint32_t type_bytes = 0;   // of one number, for those who swap bytes
  std::uint32_t block_bytes = 0;  // of a texel, or of a block of 4 x 4
  bool is_block = false;
  std::vector<Sample> samples;
};

/// Three numbers of nine bits, each with the exponent that they share.
std::vector<Sample> shared_exponent_samples() {
  std::vector<Sample> samples;
  for (std::uint32_t channel = 0; channel < 3; ++channel) {
    samples.push_back({9 * channel, 9, channel, 0, 8448});
    samples.push_back({27, 5, channel | is_exponent, 15, 31});
  }
  return samples;
}

Description describe(TexelFormat format) {
  switch (format) {
    case TexelFormat::rgba16_sfloat:
      return {2,
              8,
              false,
              {float_sample(0, 16, 0, true), float_sample(16, 16, 1, true), float_sample(32, 16, 2, true),
               float_sample(48, 16, alpha, true)}};
    case TexelFormat::b10g11r11_ufloat:
      return {
          4,
          4,
          false,
          {float_sample(0, 11, 0, false), float_sample(11, 11, 1, false), float_sample(22, 10, 2, false)}};
    case TexelFormat::e5b9g9r9_ufloat:
      return {4, 4, false, shared_exponent_samples()};
    case TexelFormat::bc6h_ufloat:
      return {1, 16, true, {float_sample(0, 128, 0, false)}};
    case TexelFormat::bc6h_sfloat:
      return {1, 16, true, {float_sample(0, 128, 0, true)}};
  }
  return {};
}

void put_u32(std::string& bytes, std::uint32_t value) {
  put(bytes, value);
}
void put_u64(std::string& bytes, std::uint64_t value) {
  put(bytes, value);
}

std::string data_format_descriptor(const Description& texel) {
  const auto block_bytes = static_cast<std::uint32_t>(24 + 16 * texel.samples.size());
  constexpr char rgbsda = 1, bc6h = '\x85';  // colour models
  std::string bytes;
  put_u32(bytes, 4 + block_bytes);
  put_u32(bytes, 0);                                   // Khronos' basic descriptor
  put_u32(bytes, 2U | block_bytes << 16U);             // its version 2
  bytes += {texel.is_block ? bc6h : rgbsda, 1, 1, 0};  // BT.709, linear, alpha not multiplied
  const char last = texel.is_block ? 3 : 0;            // of a block's sides, counted from 0
  bytes += {last, last, 0, 0};
  bytes += {static_cast<char>(texel.block_bytes), 0, 0, 0, 0, 0, 0, 0};
  for (const Sample& sample : texel.samples) {
    put_u32(bytes, sample.first_bit | (sample.bits - 1) << 16U | sample.channel << 24U);
    put_u32(bytes, 0);
    put_u32(bytes, sample.lower);
    put_u32(bytes, sample.upper);
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
  put_u32(bytes, static_cast<std::uint32_t>(entry.size()));
  bytes += entry;
  pad(bytes, 4);
  return bytes;
}

std::string compressed(const std::string& level) {
  constexpr int effort = 9;
  std::string bytes(ZSTD_compressBound(level.size()), '\0');
  const std::size_t size = ZSTD_compress(bytes.data(), bytes.size(), level.data(), level.size(), effort);
  if (ZSTD_isError(size) != 0)
    fail(ExitCode::environment, "Zstandard cannot compress a texture: {}", ZSTD_getErrorName(size));
  bytes.resize(size);
  return bytes;
}

}  // namespace

std::string ktx2_of(const Ktx2Texture& texture) {
  const Description texel = describe(texture.format);
  const std::string descriptor = data_format_descriptor(texel), values = key_values();
  constexpr std::uint32_t header_bytes = 80, level_index_bytes = 24;
  const auto levels = static_cast<std::uint32_t>(texture.levels.size());
  const std::uint32_t descriptor_at = header_bytes + level_index_bytes * levels;
  const auto values_at = descriptor_at + static_cast<std::uint32_t>(descriptor.size());

  std::string bytes("\xABKTX 20\xBB\r\n\x1A\n", 12);
  put_u32(bytes, static_cast<std::uint32_t>(texture.format));
  put_u32(bytes, texel.type_bytes);
  for (const std::uint32_t side : texture.size) put_u32(bytes, side);
  put_u32(bytes, 0);  // no array
  put_u32(bytes, 1);  // faces
  put_u32(bytes, levels);
  put_u32(bytes, texture.zstd ? 2 : 0);
  put_u32(bytes, descriptor_at);
  put_u32(bytes, static_cast<std::uint32_t>(descriptor.size()));
  put_u32(bytes, values_at);
  put_u32(bytes, static_cast<std::uint32_t>(values.size()));
  put_u64(bytes, 0);  // no data of a supercompression
  put_u64(bytes, 0);

  // The smallest level comes first in the file, the largest first in the index.
  std::string data;
  const std::size_t data_at = values_at + values.size();
  std::vector<std::array<std::uint64_t, 3>> index(levels);
  for (std::size_t i = levels; i-- > 0;) {
    const std::string& level = texture.levels[i];
    const std::string stored = texture.zstd ? compressed(level) : level;
    if (!texture.zstd)
      data.resize(
          (data_at + data.size() + texel.block_bytes - 1) / texel.block_bytes * texel.block_bytes - data_at,
          '\0');
    index[i] = {data_at + data.size(), stored.size(), level.size()};
    data += stored;
  }
  for (const auto& level : index)
    for (const std::uint64_t number : level) put_u64(bytes, number);
  return bytes + descriptor + values + data;
}

}  // namespace rnmbake
