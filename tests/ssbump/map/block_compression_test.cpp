#include "texture/block_compression.h"

#include "ssbump/map/compression_error.h"
#include "ssbump/map/weights.h"

#include <cmath>
#include <random>

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

double rms(const FloatImage& a, const FloatImage& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.data().size(); ++i) sum += std::pow(double(a.data()[i]) - b.data()[i], 2);
  return std::sqrt(sum / static_cast<double>(a.data().size()));
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
  EXPECT_LT(rms(through(TextureFormat::bc1, image), image), 1e-6);
  EXPECT_LT(rms(through(TextureFormat::bc7, image), image), 1.0 / 255);  // its shared bit costs one step
}

TEST(BlockCompression, GetsBetterWithTheBitsAndTakesAnySize) {
  for (const auto& [width, height] : {std::pair(32, 32), std::pair(5, 3), std::pair(1, 1)}) {
    const FloatImage image = gradient(width, height);
    const double bc1 = rms(through(TextureFormat::bc1, image), image);
    const double bc7 = rms(through(TextureFormat::bc7, image), image);
    EXPECT_LT(bc1, 0.5 / 31);   // half a step of five bits
    EXPECT_LT(bc7, 0.5 / 127);  // and of seven
    EXPECT_LT(rms(through(TextureFormat::rgb8, image), image), 0.5 / 255);
  }
}

TEST(BlockCompression, OfNoiseStaysNearTheBestOfALineThroughIt) {
  FloatImage image(64, 64, 3);
  std::mt19937 random(1);
  for (float& value : image.data()) value = std::uniform_real_distribution<float>(0, 1)(random);
  // A line through the colours takes a third of their variance away, and more where it can choose.
  const double all = std::sqrt(1.0 / 12);
  EXPECT_LT(rms(through(TextureFormat::bc1, image), image), all * std::sqrt(2.0 / 3));
  EXPECT_LT(rms(through(TextureFormat::bc7, image), image), all * std::sqrt(2.0 / 3));
}

TEST(BlockCompression, GivesOneChannelItsOwnLineInBc7) {
  FloatImage image(4, 4, 3);
  for (std::size_t i = 0; i < 16; ++i) {
    image.data()[3 * i] = static_cast<float>(i % 4) / 3;
    image.data()[3 * i + 1] = static_cast<float>(i / 4) / 3;
    image.data()[3 * i + 2] = static_cast<float>(i / 4) / 3;
  }
  EXPECT_LT(rms(through(TextureFormat::bc7, image), image), 1.0 / 255);  // 21/64 is not a third
  EXPECT_GT(rms(through(TextureFormat::bc1, image), image), 0.1);
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
