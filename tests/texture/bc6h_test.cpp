#include "texture/bc6h.h"

#include "base/files.h"
#include "image/layered_exr.h"
#include "support/dds_file.h"
#include "support/pictures.h"
#include "texture/bc6h_bits.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Light that falls off from a corner, of a colour that changes a little; `steepness` for each square texel.
FloatImage falloff(int width, int height, float brightest, float steepness = 0.01F) {
  FloatImage image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float light = brightest / (1 + steepness * static_cast<float>(x * x + y * y));
      set_vec3(image, x, y, {light, light * (0.7F + 0.002F * static_cast<float>(x)), 0.4F * light});
    }
  }
  return image;
}

/// Over many powers of two.
FloatImage noise(int width, int height, bool with_sign, unsigned seed) {
  FloatImage image(width, height, 3);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> exponent(-12, 12), side(-1, 1);
  for (float& value : image.data())
    value = std::exp2(exponent(random)) * (with_sign && side(random) < 0 ? -1.0F : 1.0F);
  return image;
}

FloatImage times(FloatImage image, float factor) {
  for (float& value : image.data()) value *= factor;
  return image;
}

std::vector<FloatImage> pictures(bool is_signed) {
  const float infinite = std::numeric_limits<float>::infinity();
  std::vector<FloatImage> all{falloff(64, 64, 1),          falloff(13, 7, 2000),
                              falloff(8, 8, 1e-5F),        falloff(8, 8, 1, 1),
                              FloatImage(8, 8, 3),         filled(5, 3, 3, 65504),
                              filled(4, 4, 3, infinite),   filled(4, 4, 3, std::nanf("")),
                              noise(64, 64, is_signed, 1), times(falloff(32, 32, 1), -1)};
  for (const float constant : {0.1F, 0.37F, 1.0F, 123.4F}) all.push_back(filled(4, 4, 3, constant));
  return all;
}

/// Relative RMS error over all values.
double relative_error(const FloatImage& image, bool is_signed) {
  const FloatImage seen =
      bc6h_decoded(bc6h_blocks(image, is_signed), image.width(), image.height(), is_signed);
  return rms_difference(seen, image) / rms_difference(image, filled(image.width(), image.height(), 3, 0));
}

void expect_what_openimageio_reads(const std::vector<std::uint8_t>& blocks, int width, int height,
                                   bool is_signed) {
  const TempFolder folder;
  const auto path = folder.path() / "blocks.dds";
  std::ofstream(path, std::ios::binary)
      << dds_file(is_signed ? DdsFormat::bc6h_sf16 : DdsFormat::bc6h_uf16, width, height, blocks);
  const FloatImage theirs = read_image(path).layers.at(0).pixels;
  const FloatImage ours = bc6h_decoded(blocks, width, height, is_signed);
  ASSERT_EQ(theirs.width(), width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(std::bit_cast<std::uint32_t>(theirs.texel(x, y)[c]),
                  std::bit_cast<std::uint32_t>(ours.texel(x, y)[c]))
            << x << ' ' << y << ' ' << c << ": " << theirs.texel(x, y)[c] << " and " << ours.texel(x, y)[c];
    }
  }
}

/// The modes that a picture's blocks are of, by their codes.
std::set<int> modes_of(const std::vector<std::uint8_t>& blocks) {
  std::set<int> modes;
  for (std::size_t i = 0; i < blocks.size(); i += bc6h_block_bytes) modes.insert(blocks[i] & 31);
  return modes;
}

class Bc6h : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Signs, Bc6h, testing::Bool());

TEST_P(Bc6h, BlocksAreReadByOpenImageIoAsByOurDecoder) {
  for (const FloatImage& image : pictures(GetParam()))
    expect_what_openimageio_reads(bc6h_blocks(image, GetParam()), image.width(), image.height(), GetParam());
}

/// Any bits behind the code of a mode of one line are a block, many of which no encoder writes.
TEST_P(Bc6h, RandomBlocksAreReadByOpenImageIoAsByOurDecoder) {
  std::mt19937 random(7);
  std::vector<std::uint8_t> blocks(std::size_t(64) * bc6h_block_bytes);
  for (std::uint8_t& byte : blocks) byte = static_cast<std::uint8_t>(random());
  for (std::size_t i = 0; i < 64; ++i) {
    std::uint8_t& first = blocks[i * bc6h_block_bytes];
    first = static_cast<std::uint8_t>((first & ~31) | bc6h_modes()[i % 4].code);
  }
  expect_what_openimageio_reads(blocks, 32, 32, GetParam());
}

/// 16 steps over what changes within a block: up to 40 % in the first, 8 % in the second.
TEST_P(Bc6h, LosesWhatIsBetweenItsSteps) {
  for (const float brightest : {1.0F, 500.0F}) {
    EXPECT_LT(relative_error(falloff(64, 64, brightest), GetParam()), 1e-2);
    EXPECT_LT(relative_error(falloff(64, 64, brightest, 4e-4F), GetParam()), 3e-3);
  }
}

TEST_P(Bc6h, OneColourIsAsGoodAsHalfFloats) {
  for (const float value : {0.1F, 0.37F, 1.0F, 123.4F})
    EXPECT_LT(relative_error(filled(4, 4, 3, value), GetParam()), 1.0 / 2048) << value;
}

TEST_P(Bc6h, EveryModeIsOfUse) {
  std::set<int> modes;
  for (const FloatImage& image : pictures(GetParam())) modes.merge(modes_of(bc6h_blocks(image, GetParam())));
  EXPECT_EQ(modes, (std::set<int>{3, 7, 11, 15}));
}

TEST(Bc6hRange, HasNoSignUnlessAsked) {
  const FloatImage below = times(falloff(16, 16, 1), -1);
  const FloatImage seen = bc6h_decoded(bc6h_blocks(below, false), 16, 16, false);
  EXPECT_EQ(largest_difference(seen, FloatImage(16, 16, 3)), 0);
  EXPECT_LT(relative_error(below, true), 1e-2);
}

TEST(Bc6hRange, IsClampedToHalfFloats) {
  const FloatImage seen = bc6h_decoded(bc6h_blocks(filled(4, 4, 3, 1e9F), false), 4, 4, false);
  EXPECT_EQ(largest_difference(seen, filled(4, 4, 3, 65504)), 0);
}

/// One bright channel, and noise near 0 in another, which must not take the end points for itself.
TEST(Bc6hError, IsOfLightAndNotOfBits) {
  FloatImage image = falloff(32, 32, 1);
  const FloatImage rough = noise(32, 32, false, 3);
  for (std::size_t i = 1; i < image.data().size(); i += 3)
    image.data()[i] = 1e-4F * std::min(rough.data()[i], 1.0F);
  EXPECT_LT(relative_error(image, false), 7e-3);
}

TEST(Bc6hDecoder, RefusesWhatItDoesNotRead) {
  EXPECT_THROW((void)bc6h_decoded(std::vector<std::uint8_t>(16), 4, 4, false),
               std::invalid_argument);  // two lines
  EXPECT_THROW((void)bc6h_decoded(std::vector<std::uint8_t>(16, 3), 8, 4, false), std::invalid_argument);
}

}  // namespace
}  // namespace rnmbake
