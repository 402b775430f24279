#include "image/sample.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

FloatImage ramp(int width, int height) {
  FloatImage image(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.texel(x, y)[0] = static_cast<float>(x + 100 * y);
  return image;
}

float looked_up(const FloatImage& image, const Vec2& uv, Border border = Border::clamp) {
  float value = 0;
  sample(image, bilinear_taps(image, uv, border), {&value, 1});
  return value;
}

TEST(Sample, TexelCentresAreExactEvenBesideNaN) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 7}, {1, 9}, {8192, 2}}) {
    FloatImage image = ramp(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        ASSERT_EQ(looked_up(image, texel_uv(image, x, y)), image.texel(x, y)[0]);
  }
  FloatImage image = ramp(3, 3);
  image.texel(1, 1)[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(looked_up(image, texel_uv(image, 0, 1)), 100);
}

TEST(Sample, RowZeroIsOnTop) {
  const FloatImage image = ramp(2, 4);
  EXPECT_EQ(looked_up(image, {0.25F, 0.875F}), 0);
  EXPECT_EQ(looked_up(image, {0.25F, 0.125F}), 300);
}

TEST(Sample, BetweenTexelsIsLinear) {
  const FloatImage image = ramp(4, 4);
  EXPECT_NEAR(looked_up(image, {0.5F, 0.5F}), 1.5 + 150, 1e-4);
  EXPECT_NEAR(looked_up(image, {(1 + 0.5F + 0.25F) / 4, 1 - (2 + 0.5F + 0.75F) / 4}), 1.25 + 275, 1e-3);
}

TEST(Sample, BordersClampOrWrap) {
  const FloatImage image = ramp(4, 1);
  EXPECT_EQ(looked_up(image, {0, 0.5F}), 0);
  EXPECT_EQ(looked_up(image, {1e30F, 0.5F}), 3);
  EXPECT_NEAR(looked_up(image, {0, 0.5F}, Border::wrap), 1.5, 1e-6);  // half of texel 3, half of texel 0
  EXPECT_EQ(looked_up(image, {-2 + 0.375F, 0.5F}, Border::wrap), 1);
  EXPECT_EQ(looked_up(image, {5 + 0.625F, 0.5F}, Border::wrap), 2);
}

TEST(Sample, UncoveredTexelsAreLeftOut) {
  const FloatImage image = ramp(2, 1);
  FloatImage coverage(2, 1, 1);
  coverage.texel(1, 0)[0] = 1;
  float value = 0;
  const auto taps = bilinear_taps(image, {0.5F, 0.5F}, Border::clamp);
  sample(image, covered_taps(taps, coverage), {&value, 1});
  EXPECT_NEAR(value, 1, 1e-6);
  sample(image, covered_taps(taps, FloatImage(2, 1, 1)), {&value, 1});
  EXPECT_NEAR(value, 0.5, 1e-6);
}

}  // namespace
}  // namespace rnmbake
