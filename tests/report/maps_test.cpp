#include "report/maps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

FloatImage ramp(int width, int height, int channels) {
  FloatImage image(width, height, channels);
  for (std::size_t i = 0; i < image.data().size(); ++i) image.data()[i] = static_cast<float>(i);
  return image;
}

TEST(Maps, FewObjectsMayHaveLargerOnes) {
  EXPECT_EQ(map_limit(1, 4), 256);
  EXPECT_EQ(map_limit(200, 4), 64);
  EXPECT_GE(map_limit(100000, 4), 16);
  EXPECT_EQ(map_limit(0, 0), 256);
}

TEST(Maps, ShrinkByMeansOfBlocks) {
  const FloatImage small = shrink(ramp(4, 4, 1), 2);
  ASSERT_EQ(small.width(), 2);
  ASSERT_EQ(small.height(), 2);
  EXPECT_EQ(small.texel(0, 0)[0], (0 + 1 + 4 + 5) / 4.0F);
  EXPECT_EQ(small.texel(1, 1)[0], (10 + 11 + 14 + 15) / 4.0F);
}

TEST(Maps, ShrinkKeepsWhatFitsAndTheRestOfUnevenSizes) {
  EXPECT_EQ(shrink(ramp(5, 3, 3), 8).data(), ramp(5, 3, 3).data());
  const FloatImage small = shrink(ramp(5, 3, 1), 3);
  EXPECT_EQ(small.width(), 3);
  EXPECT_EQ(small.height(), 2);
  EXPECT_EQ(small.texel(2, 1)[0], 14);  // a block of one texel
}

TEST(Maps, NothingCountsForNothing) {
  FloatImage image = ramp(4, 2, 1);
  for (const int x : {0, 1}) image.texel(x, 0)[0] = std::numeric_limits<float>::quiet_NaN();
  image.texel(0, 1)[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(shrink(image, 2).texel(0, 0)[0], 5);
  image.texel(1, 1)[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(shrink(image, 2).texel(0, 0)[0]));
}

TEST(Maps, ShowMeansOfHalvesAndTheirNoise) {
  FloatImage first(2, 1, 3), second(2, 1, 3), reference(2, 1, 3), mask(2, 1, 1);
  std::ranges::fill(first.data(), 1.0F);
  std::ranges::fill(second.data(), 3.0F);
  mask.texel(1, 0)[0] = 1;
  const BasisMaps maps = make_maps("flat", {&first, &second, nullptr}, {&reference}, {{&mask}}, 16);
  EXPECT_EQ(maps.basis, "flat");
  EXPECT_TRUE(std::isnan(maps.candidate.texel(0, 0)[0]));
  EXPECT_EQ(maps.candidate.texel(1, 0)[2], 2);
  EXPECT_EQ(maps.candidate_noise.texel(1, 0)[0], 1);
  EXPECT_TRUE(maps.reference_noise.empty());
}

}  // namespace
}  // namespace rnmbake
