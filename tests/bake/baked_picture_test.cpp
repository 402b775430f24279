#include "bake/baked_picture.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// A picture of which every third texel is not covered; `value` of a texel and channel.
template <typename Value>
FloatImage picture(int width, int height, Value value) {
  FloatImage image(width, height, 4);
  for (std::size_t i = 0; i < image.texels(); ++i) {
    if (i % 3 == 2) continue;
    for (std::size_t c = 0; c < 3; ++c) image.data()[4 * i + c] = float(value(i, c));
    image.data()[4 * i + 3] = 1;
  }
  return image;
}

BakedPicture noisy(int width, int height, double sigma, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(2, sigma);
  BakedPicture baked;
  for (const int half : {0, 1, 0, 1})
    baked.add(half, picture(width, height, [&](std::size_t, std::size_t) { return normal(random); }), 16);
  return baked;
}

TEST(BakedPicture, IsTheMeanOfItsSamples) {
  BakedPicture baked;
  const auto flat = [](double value) {
    return picture(5, 4, [=](std::size_t, std::size_t) { return value; });
  };
  baked.add(0, flat(1), 10);
  baked.add(0, flat(4), 20);
  EXPECT_FLOAT_EQ(baked.mean().data()[0], 3);
  EXPECT_FALSE(baked.has_error());
  baked.add(1, flat(6), 10);
  EXPECT_EQ(baked.all_samples(), 40);
  EXPECT_FLOAT_EQ(baked.mean().data()[0], (1 * 10 + 4 * 20 + 6 * 10) / 40.0F);
  EXPECT_EQ(baked.mean().data()[3], 1);
  EXPECT_EQ(baked.mean().data()[4 * 2 + 3], 0);
  EXPECT_DOUBLE_EQ(baked.variance_factor(), 30.0 * 10 / 1600);
}

TEST(BakedPicture, ComesBackFromBytes) {
  std::vector<BakedPicture> pictures{noisy(7, 5, 0.3, 1), noisy(1, 1, 0.3, 2), BakedPicture{}};
  pictures[1].halves[1] = {};
  pictures[1].samples[1] = 0;
  const std::string bytes = to_bytes(pictures);
  const auto back = from_bytes(bytes);
  ASSERT_TRUE(back);
  ASSERT_EQ(back->size(), pictures.size());
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    EXPECT_EQ((*back)[i].samples, pictures[i].samples);
    for (const std::size_t half : {0U, 1U})
      EXPECT_EQ((*back)[i].halves[half].data(), pictures[i].halves[half].data());
  }
  for (std::size_t length = 0; length < bytes.size(); length += 13)
    EXPECT_FALSE(from_bytes(std::string_view(bytes).substr(0, length)));
  EXPECT_FALSE(from_bytes(bytes + "x"));
}

TEST(NoiseSums, SayTheStandardErrorOfTheMean) {
  const double sigma = 0.2;  // of each of four passes: their mean has half of that
  NoiseSums sums;
  sums.add(noisy(100, 100, sigma, 3));
  // 20,000 squares of normal numbers: their mean is known to 1 %, its root to half of that.
  EXPECT_NEAR(sums.relative(), sigma / 2 / 2, 4 * 0.005 * sigma / 4);
  EXPECT_EQ(NoiseSums{}.relative(), 0);
}

}  // namespace
}  // namespace rnmbake
