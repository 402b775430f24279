#include "texture/block_compression.h"

#include "base/files.h"
#include "image/layered_exr.h"
#include "ssbump/map/compression_error.h"
#include "ssbump/map/weights.h"
#include "support/dds_file.h"
#include "support/pictures.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

FloatImage gradient(int width, int height) {
  FloatImage image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float t = static_cast<float>(x + y) / static_cast<float>(width + height);
      const auto texel = image.texel(x, y);
      texel[0] = 0.1F + 0.3F * t;
      texel[1] = 0.5F - 0.2F * t;
      texel[2] = 0.2F;
    }
  }
  return image;
}

FloatImage noise(int width, int height) {
  FloatImage image(width, height, 3);
  std::mt19937 random(1);
  for (float& value : image.data()) value = std::uniform_real_distribution<float>(0, 1)(random);
  return image;
}

/// Smooth in two channels, noise in the other: what BC7's modes 4 and 5 are for.
FloatImage noise_in(std::size_t channel, FloatImage image) {
  const FloatImage rough = noise(image.width(), image.height());
  for (std::size_t i = channel; i < image.data().size(); i += 3) image.data()[i] = rough.data()[i];
  return image;
}

/// What OpenImageIO's decoder, which knows nothing of ours, reads out of the blocks.
FloatImage read_by_openimageio(TextureFormat format, const FloatImage& image) {
  const TempFolder folder;
  const auto path = folder.path() / "blocks.dds";
  std::ofstream(path, std::ios::binary)
      << dds_file(format == TextureFormat::bc1 ? DdsFormat::bc1 : DdsFormat::bc7_unorm, image.width(),
                  image.height(), blocks_of(format, image));
  const FloatImage whole = read_image(path).layers.at(0).pixels;
  FloatImage colours(whole.width(), whole.height(), 3);
  for (int y = 0; y < whole.height(); ++y) {
    for (int x = 0; x < whole.width(); ++x) {
      for (std::size_t c = 0; c < 3; ++c) colours.texel(x, y)[c] = whole.texel(x, y)[c];
      if (whole.channels() == 4) {
        EXPECT_EQ(whole.texel(x, y)[3], 1) << "alpha at " << x << ' ' << y;
      }
    }
  }
  return colours;
}

const std::vector<FloatImage>& pictures() {
  static const std::vector<FloatImage> all{gradient(32, 32),
                                           gradient(5, 3),
                                           gradient(1, 1),
                                           FloatImage(8, 8, 3),
                                           noise(64, 64),
                                           noise(7, 9),
                                           noise_in(0, gradient(32, 32)),
                                           noise_in(1, gradient(32, 32)),
                                           noise_in(2, gradient(32, 32))};
  return all;
}

TEST(BlockCompression, OfBc7IsWhatAnotherDecoderReadsOutOfItsBlocks) {
  for (const FloatImage& image : pictures()) {
    const FloatImage ours = through(TextureFormat::bc7, image);
    EXPECT_LT(largest_difference(read_by_openimageio(TextureFormat::bc7, image), ours), 1e-6);
  }
}

TEST(BlockCompression, OfBc1IsWhatAnotherDecoderReadsOutOfItsBlocksUpToRounding) {
  for (const FloatImage& image : pictures()) {
    const FloatImage ours = through(TextureFormat::bc1, image);
    // Decoders make 8 bits of 5 by repeating or by rounding, which is at most 1 apart, and may cut thirds
    // off.
    EXPECT_LT(largest_difference(read_by_openimageio(TextureFormat::bc1, image), ours), (1 + 0.67) / 255);
  }
}

TEST(BlockCompression, UsesEveryModeOfBc7WithEveryChannelAlone) {
  std::set<std::pair<int, int>> used;  // mode; 1 to 3, the channel alone; 4 more: its steps have fewer bits
  for (const FloatImage& image : pictures()) {
    const auto blocks = blocks_of(TextureFormat::bc7, image);
    ASSERT_EQ(blocks.size() % 16, 0U);
    for (std::size_t at = 0; at < blocks.size(); at += 16) {
      const int mode = std::countr_zero(blocks[at]), first = blocks[at] | blocks[at + 1] << 8;
      used.emplace(mode, mode == 6 ? 0 : first >> (mode + 1) & (mode == 4 ? 7 : 3));
    }
  }
  const std::set<std::pair<int, int>> all{{6, 0}, {5, 1}, {5, 2}, {5, 3}, {4, 1},
                                          {4, 2}, {4, 3}, {4, 5}, {4, 6}, {4, 7}};
  EXPECT_EQ(used, all);
}

TEST(BlockCompression, RoundsAsTheFormatsDo) {
  FloatImage image(1, 1, 3);
  image.data() = {0.5F, 0.5F, 1.0F};
  const FloatImage rgb565 = through(TextureFormat::rgb565, image);
  EXPECT_FLOAT_EQ(rgb565.data()[0] * 255, 132);  // 16 of 31: 10000 -> 10000100
  EXPECT_FLOAT_EQ(rgb565.data()[1] * 255, 130);  // 32 of 63: 100000 -> 10000010
  EXPECT_FLOAT_EQ(rgb565.data()[2] * 255, 255);
  EXPECT_FLOAT_EQ(through(TextureFormat::rgb8, image).data()[0] * 255, 128);
}

TEST(BlockCompression, HoldsTwoColoursOfABlockAsTheirEndPoints) {
  FloatImage image(4, 4, 3);
  for (std::size_t i = 0; i < 16; ++i)
    for (std::size_t c = 0; c < 3; ++c) image.data()[3 * i + c] = i % 3 == 0 ? 0 : 1;
  EXPECT_LT(rms_difference(through(TextureFormat::bc1, image), image), 1e-6);
  EXPECT_LT(rms_difference(through(TextureFormat::bc7, image), image),
            1.0 / 255);  // its shared bit costs one step
}

TEST(BlockCompression, GetsBetterWithTheBitsAndTakesAnySize) {
  for (const auto& [width, height] : {std::pair(32, 32), std::pair(5, 3), std::pair(1, 1)}) {
    const FloatImage image = gradient(width, height);
    const double bc1 = rms_difference(through(TextureFormat::bc1, image), image);
    const double bc7 = rms_difference(through(TextureFormat::bc7, image), image);
    EXPECT_LT(bc1, 0.5 / 31);   // half a step of five bits
    EXPECT_LT(bc7, 0.5 / 127);  // and of seven
    EXPECT_LT(rms_difference(through(TextureFormat::rgb8, image), image), 0.5 / 255);
  }
}

TEST(BlockCompression, OfNoiseStaysNearTheBestOfALineThroughIt) {
  const FloatImage image = noise(64, 64);
  // A line through the colours takes a third of their variance away, and more where it can choose.
  const double all = std::sqrt(1.0 / 12);
  EXPECT_LT(rms_difference(through(TextureFormat::bc1, image), image), all * std::sqrt(2.0 / 3));
  EXPECT_LT(rms_difference(through(TextureFormat::bc7, image), image), all * std::sqrt(2.0 / 3));
}

TEST(BlockCompression, GivesOneChannelItsOwnLineInBc7) {
  FloatImage image(4, 4, 3);
  for (std::size_t i = 0; i < 16; ++i) {
    image.data()[3 * i] = static_cast<float>(i % 4) / 3;
    image.data()[3 * i + 1] = static_cast<float>(i / 4) / 3;
    image.data()[3 * i + 2] = static_cast<float>(i / 4) / 3;
  }
  EXPECT_LT(rms_difference(through(TextureFormat::bc7, image), image), 1.0 / 255);  // 21/64 is not a third
  EXPECT_GT(rms_difference(through(TextureFormat::bc1, image), image), 0.1);
}

TEST(CompressionError, IsZeroOfTheSameAndKnowsAScaledMap) {
  FloatImage weights(8, 8, SsbumpWeights::channels);
  for (float& value : weights.data()) value = 1;
  FloatImage dimmed = weights;
  for (float& value : dimmed.data()) value = 0.9F;
  const CompressionError none = weights_error(weights, weights), some = weights_error(dimmed, weights);
  EXPECT_EQ(none.diffuse_rms, 0);
  EXPECT_EQ(none.angle_max, 0);
  EXPECT_NEAR(some.diffuse_rms, 0.1, 1e-6);  // of what the open surface receives
  EXPECT_NEAR(some.diffuse_max, 0.1, 1e-6);
  EXPECT_LT(some.diffuse_bias, 0);
  EXPECT_NEAR(some.angle_max, 0, 1e-4);
}

TEST(CompressionError, FallsWithTheScaleThatUsesMoreOfTheRange) {
  FloatImage weights(32, 32, SsbumpWeights::channels);
  std::mt19937 random(9);
  for (float& value : weights.data()) value = std::uniform_real_distribution<float>(0, 1)(random);
  SsbumpEncoding encoding;
  const double third = compression_error(weights, encoding, TextureFormat::rgb565).diffuse_rms;
  encoding.scale = SsbumpScale::ndotb;
  EXPECT_LT(compression_error(weights, encoding, TextureFormat::rgb565).diffuse_rms, 0.7 * third);
}

}  // namespace
}  // namespace rnmbake
