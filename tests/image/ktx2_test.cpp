#include "image/ktx2.h"

#include "base/bytes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

std::uint32_t u32_at(const std::string& file, std::size_t at) {
  std::uint32_t value = 0;
  EXPECT_TRUE(ByteReader(std::string_view(file).substr(at)).take(value));
  return value;
}

struct Level {
  std::uint64_t at = 0, bytes = 0, uncompressed = 0;
};
Level level_of(const std::string& file, std::size_t level) {
  Level found;
  EXPECT_TRUE(ByteReader(std::string_view(file).substr(80 + 24 * level)).take(found));
  return found;
}

constexpr std::size_t header_levels = 40, header_supercompression = 44, header_descriptor = 48;

struct Described {
  TexelFormat format;
  std::uint32_t type_bytes, block_bytes;
  /// First bit and number of bits less one; channel with qualifiers; lower and upper bound: as the "Khronos
  /// Data Format Specification" and the tables of its examples have them.
  std::vector<std::array<std::uint32_t, 5>> samples;
};
const std::vector<Described>& descriptions() {
  constexpr std::uint32_t one = 0x3F800000, minus_one = 0xBF800000;
  static const std::vector<Described> all{
      {TexelFormat::rgba16_sfloat,
       2,
       8,
       {{0, 15, 0xC0, minus_one, one},
        {16, 15, 0xC1, minus_one, one},
        {32, 15, 0xC2, minus_one, one},
        {48, 15, 0xCF, minus_one, one}}},
      {TexelFormat::b10g11r11_ufloat,
       4,
       4,
       {{0, 10, 0x80, 0, one}, {11, 10, 0x81, 0, one}, {22, 9, 0x82, 0, one}}},
      {TexelFormat::e5b9g9r9_ufloat,
       4,
       4,
       {{0, 8, 0, 0, 8448},
        {27, 4, 0x20, 15, 31},
        {9, 8, 1, 0, 8448},
        {27, 4, 0x21, 15, 31},
        {18, 8, 2, 0, 8448},
        {27, 4, 0x22, 15, 31}}},
      {TexelFormat::bc6h_ufloat, 1, 16, {{0, 127, 0x80, 0, one}}},
      {TexelFormat::bc6h_sfloat, 1, 16, {{0, 127, 0xC0, minus_one, one}}}};
  return all;
}

TEST(Ktx2, DescribesEachFormat) {
  for (const Described& one : descriptions()) {
    const std::string file =
        ktx2_of({.format = one.format, .size = {4, 4, 0}, .levels = {std::string(128, 'x')}});
    EXPECT_EQ(u32_at(file, 12), static_cast<std::uint32_t>(one.format));
    EXPECT_EQ(u32_at(file, 16), one.type_bytes);
    const std::size_t at = u32_at(file, header_descriptor);
    ASSERT_EQ(u32_at(file, at), 4 + 24 + 16 * one.samples.size());
    const bool is_block = one.block_bytes == 16;
    EXPECT_EQ(u32_at(file, at + 12), is_block ? 0x00010185U : 0x00010101U);  // model, BT.709, linear
    EXPECT_EQ(u32_at(file, at + 16), is_block ? 0x0303U : 0U);
    EXPECT_EQ(u32_at(file, at + 20), one.block_bytes);
    for (std::size_t i = 0; i < one.samples.size(); ++i) {
      const std::size_t sample = at + 28 + 16 * i;
      const auto& [first, last, channel, lower, upper] = one.samples[i];
      EXPECT_EQ(u32_at(file, sample), first | last << 16U | channel << 24U);
      EXPECT_EQ(u32_at(file, sample + 8), lower);
      EXPECT_EQ(u32_at(file, sample + 12), upper);
    }
  }
}

TEST(Ktx2, AlignsItsLevelsTheSmallestFirst) {
  for (const Described& one : descriptions()) {
    const std::vector<std::string> levels{std::string(48, 'a'), std::string(16, 'b'), std::string(16, 'c')};
    const std::string file = ktx2_of({.format = one.format, .size = {8, 4, 0}, .levels = levels});
    ASSERT_EQ(u32_at(file, header_levels), 3U);
    std::uint64_t end = file.size();
    for (std::size_t i = 0; i < 3; ++i) {
      const Level level = level_of(file, i);
      EXPECT_EQ(level.at % one.block_bytes, 0U);
      EXPECT_LE(level.at + level.bytes, end);
      EXPECT_EQ(file.substr(level.at, level.bytes), levels[i]);
      EXPECT_EQ(level.uncompressed, level.bytes);
      end = level.at;
    }
  }
}

TEST(Ktx2, IsSmallerWithZstandard) {
  const std::string texels(1 << 16, 'x');
  const std::string file = ktx2_of({.size = {128, 64, 0}, .levels = {texels}, .zstd = true});
  EXPECT_EQ(u32_at(file, header_supercompression), 2U);
  const Level level = level_of(file, 0);
  EXPECT_EQ(level.uncompressed, texels.size());
  EXPECT_EQ(level.at + level.bytes, file.size());
  EXPECT_LT(level.bytes, 200U);
  EXPECT_EQ(file.substr(level.at, 4), "\x28\xB5\x2F\xFD");  // how every frame begins
}

}  // namespace
}  // namespace rnmbake
