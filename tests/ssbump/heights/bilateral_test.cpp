#include "ssbump/heights/bilateral.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

HeightField noise(int width, int height, WrapMode x, WrapMode y) {
  HeightField field{FloatImage(width, height, 1), x, y};
  std::mt19937 random(3);
  for (float& value : field.heights.data()) value = std::uniform_real_distribution<float>(0, 3)(random);
  return field;
}

/// The definition, in double precision, without any thought of speed.
double defined(const HeightField& field, int x, int y, int radius, double edge) {
  const auto fold = [](int at, int count, WrapMode beyond) {
    if (beyond == WrapMode::none) return std::clamp(at, 0, count - 1);
    while (at < 0 || at >= count) {
      if (beyond == WrapMode::wrap) at += at < 0 ? count : -count;
      if (beyond == WrapMode::mirror) at = at < 0 ? -1 - at : 2 * count - 1 - at;
    }
    return at;
  };
  const double centre = field.heights.texel(x, y)[0], sigma = radius / 2.0;
  double sum = 0, weights = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      if (dx * dx + dy * dy > radius * radius) continue;
      const double height =
          field.heights.texel(fold(x + dx, field.width(), field.x), fold(y + dy, field.height(), field.y))[0];
      const double t = std::max(0.0, 1 - std::pow((height - centre) / edge, 2));
      const double weight = std::exp(-(dx * dx + dy * dy) / (2 * sigma * sigma)) * t * t;
      weights += weight;
      sum += weight * height;
    }
  }
  return sum / weights;
}

TEST(Bilateral, IsItsDefinitionAtEverySizeAndBorder) {
  for (const WrapMode beyond : {WrapMode::wrap, WrapMode::mirror, WrapMode::none}) {
    for (const auto& [width, height] :
         {std::pair(37, 5), std::pair(1, 1), std::pair(1, 40), std::pair(70, 33)}) {
      const HeightField field = noise(width, height, beyond, WrapMode::wrap);
      const FloatImage filtered = bilateral(field, {7, 1.2F, 2});
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          ASSERT_NEAR(filtered.texel(x, y)[0], defined(field, x, y, 7, 1.2), 1e-5) << x << " " << y;
    }
  }
}

TEST(Bilateral, TakesStairStepsOutOfASlopeAndKeepsTheEdge) {
  constexpr int side = 96;
  HeightField field{FloatImage(side, side, 1), WrapMode::none, WrapMode::none};
  const auto smooth = [](int x) { return 0.02F * static_cast<float>(x) + (x >= 48 ? 8.0F : 0.0F); };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) field.heights.texel(x, y)[0] = std::round(8 * smooth(x)) / 8;
  const FloatImage filtered = bilateral(field, {10, 1, 2});
  double before = 0, after = 0;
  for (int x = 12; x < side - 12; ++x) {
    if (std::abs(x - 48) < 12) continue;
    const float mean = smooth(x);
    before += std::pow(field.heights.texel(x, 40)[0] - mean, 2);
    after += std::pow(filtered.texel(x, 40)[0] - mean, 2);
  }
  EXPECT_LT(after, before / 9);  // a third of the stair-steps' size is left
  // Each side is a mean of heights of its own within the radius.
  const auto height = [&](int x) { return field.heights.texel(x, 40)[0]; };
  const float edge = filtered.texel(48, 40)[0] - filtered.texel(47, 40)[0];
  EXPECT_GE(edge, height(48) - height(47));
  EXPECT_LE(edge, height(58) - height(37));
}

TEST(Bilateral, SwitchedOffChangesNothing) {
  const HeightField field = noise(12, 9, WrapMode::wrap, WrapMode::wrap);
  EXPECT_EQ(bilateral(field, {0, 1, 0}).data(), field.heights.data());
}

}  // namespace
}  // namespace rnmbake
