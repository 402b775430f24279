#include "lightmap/faults.h"

#include "support/pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

void set(FloatImage& image, int x, int y, float value) {
  std::ranges::fill(image.texel(x, y), value);
}

std::ptrdiff_t fireflies(const FloatImage& image) {
  return std::ranges::count(find_faults(image, filled(image.width(), image.height(), 1, 1)),
                            TexelFault::firefly);
}

TEST(Faults, LoneBrightTexelIsAFirefly) {
  FloatImage image = filled(9, 9, 3, 0.5F);
  set(image, 4, 4, 0.5F * 8.1F);
  EXPECT_EQ(fireflies(image), 1);
  set(image, 4, 4, 0.5F * 7.9F);
  EXPECT_EQ(fireflies(image), 0);
}

TEST(Faults, CornersAndStripsHaveFirefliesToo) {
  FloatImage image = filled(9, 9, 3, 1);
  set(image, 0, 0, 100);
  EXPECT_EQ(fireflies(image), 1);
  FloatImage strip = filled(9, 1, 3, 1);
  set(strip, 4, 0, 100);
  EXPECT_EQ(fireflies(strip), 1);
}

// Sun on a dark floor: however sharp and bright, edges have a neighbour as bright.
TEST(Faults, EdgesOfLightAreNone) {
  FloatImage half = filled(16, 16, 3, 0.001F), corner = half, diagonal = half, streak = half;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      if (x >= 8) set(half, x, y, 1000);
      if (x >= 8 && y >= 8) set(corner, x, y, 1000);
      if (x > y) set(diagonal, x, y, 1000);
      if (x == 5 && y > 3 && y < 9) set(streak, x, y, 1000);
    }
  }
  EXPECT_EQ(fireflies(half), 0);
  EXPECT_EQ(fireflies(corner), 0);
  EXPECT_EQ(fireflies(diagonal), 0);
  EXPECT_EQ(fireflies(streak), 0);
}

// Noise in a dark corner of a lit map, many times its neighbours, is no firefly: nobody sees it.
TEST(Faults, NoiseInTheDarkIsNone) {
  FloatImage image = filled(16, 16, 3, 1);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 5; ++x) set(image, x, y, 0.0001F);
  set(image, 2, 8, 0.1F);
  EXPECT_EQ(fireflies(image), 0);
}

TEST(Faults, OrdinaryNoiseIsNone) {
  FloatImage image(64, 64, 3);
  std::mt19937 random(3);
  std::gamma_distribution<float> noise(4, 0.25F);  // 50 % relative noise: a very short bake
  for (float& value : image.data()) value = noise(random);
  EXPECT_EQ(fireflies(image), 0);
}

TEST(Faults, UncoveredTexelsNeitherCountNorJudge) {
  FloatImage image = filled(3, 1, 3, 0), coverage = filled(3, 1, 1, 0);
  set(image, 1, 0, 100);
  set(image, 0, 0, not_a_number);
  coverage.texel(1, 0)[0] = 1;
  const auto faults = find_faults(image, coverage);
  EXPECT_EQ(std::ranges::count(faults, TexelFault::none), 3);
}

TEST(Faults, OneBadChannelIsEnough) {
  FloatImage image = filled(4, 4, 3, 1);
  image.texel(1, 1)[2] = not_a_number;
  image.texel(2, 3)[0] = infinity;
  image.texel(3, 3)[1] = -infinity;
  EXPECT_EQ(std::ranges::count(find_faults(image, filled(4, 4, 1, 1)), TexelFault::non_finite), 3);
}

TEST(Repair, TakesTheMeanOfSoundNeighboursAndNothingElse) {
  FloatImage image = filled(5, 5, 3, 1), coverage = filled(5, 5, 1, 1);
  set(image, 1, 1, not_a_number);
  set(image, 2, 1, infinity);
  set(image, 0, 0, 2);
  coverage.texel(0, 1)[0] = 0;  // holds 1, must not be asked
  set(image, 0, 1, 50);
  const FloatImage before = image;
  EXPECT_EQ(repair_faults(image, coverage, find_faults(image, coverage)), 2U);
  EXPECT_NEAR(image.texel(1, 1)[0], 7.0 / 6,
              1e-6);  // 8 neighbours less one bad, one uncovered; one of them is 2
  EXPECT_NEAR(image.texel(2, 1)[1], 1, 1e-6);
  EXPECT_EQ(image.texel(0, 1)[0], 50);
  EXPECT_EQ(image.texel(3, 3)[0], before.texel(3, 3)[0]);
}

TEST(Repair, LargeHolesCloseAndHopelessOnesAreBlack) {
  FloatImage image = filled(9, 9, 3, 2), coverage = filled(9, 9, 1, 1);
  for (int y = 2; y < 7; ++y)
    for (int x = 2; x < 7; ++x) set(image, x, y, not_a_number);
  EXPECT_EQ(repair_faults(image, coverage, find_faults(image, coverage)), 25U);
  EXPECT_TRUE(std::ranges::all_of(image.data(), [](float value) { return std::abs(value - 2) < 1e-5F; }));
  FloatImage lost = filled(2, 2, 3, not_a_number);
  const FloatImage all = filled(2, 2, 1, 1);
  EXPECT_EQ(repair_faults(lost, all, find_faults(lost, all)), 4U);
  EXPECT_TRUE(std::ranges::all_of(lost.data(), [](float value) { return value == 0; }));
}

}  // namespace
}  // namespace rnmbake
