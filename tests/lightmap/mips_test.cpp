#include "lightmap/mips.h"

#include "support/pictures.h"

#include <cmath>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(Mips, AreAsManyAsThePaddingAllows) {
  EXPECT_EQ(mips_within(0), 0);
  EXPECT_EQ(mips_within(1), 0);
  EXPECT_EQ(mips_within(3), 1);
  EXPECT_EQ(mips_within(4), 2);
  EXPECT_EQ(mips_within(64), 6);
}

TEST(Mips, AreMeansOfCoveredTexelsAlone) {
  FloatImage image = filled(4, 2, 1, 1000), coverage(4, 2, 1);
  image.texel(0, 0)[0] = 1;
  image.texel(1, 1)[0] = 4;
  coverage.texel(0, 0)[0] = coverage.texel(1, 1)[0] = 1;
  const std::vector<MipLevel> levels = mip_levels(image, coverage, 1, 2);
  ASSERT_EQ(levels.size(), 1U);
  EXPECT_EQ(levels[0].image.width(), 2);
  EXPECT_EQ(levels[0].image.height(), 1);
  EXPECT_FLOAT_EQ(levels[0].image.texel(0, 0)[0], 2.5F);
  EXPECT_EQ(levels[0].coverage.texel(1, 0)[0], 0);
  EXPECT_FLOAT_EQ(levels[0].image.texel(1, 0)[0], 2.5F);  // filled from its neighbour
}

/// A constant map stays that on every level, whatever lies around, sides odd or not.
TEST(Mips, LetNothingInFromAround) {
  FloatImage image = filled(37, 22, 3, -5), coverage(37, 22, 1);
  for (int y = 4; y < 17; ++y) {
    for (int x = 9; x < 30; ++x) {
      set_vec3(image, x, y, {2, 3, 4});
      coverage.texel(x, y)[0] = 1;
    }
  }
  for (const MipLevel& level : mip_levels(image, coverage, 3, 8)) {
    for (int y = 0; y < level.image.height(); ++y) {
      for (int x = 0; x < level.image.width(); ++x) {
        const Vec3 seen = vec3_at(level.image, x, y);
        EXPECT_TRUE(seen == Vec3(2, 3, 4) || (seen == Vec3(0, 0, 0) && level.coverage.texel(x, y)[0] == 0));
      }
    }
  }
}

TEST(Mips, KeepTheMeanOfAFullPicture) {
  for (const int width : {16, 15, 7}) {
    FloatImage image(width, 8, 1);
    double mean = 0;
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < width; ++x) {
        image.texel(x, y)[0] = std::sin(static_cast<float>(x * y + x));
        mean += double(image.texel(x, y)[0]) / (8 * width);
      }
    }
    const std::vector<MipLevel> levels = mip_levels(image, filled(width, 8, 1, 1), 3, 8);
    double last = 0;
    for (const float value : levels.back().image.data())
      last += double(value) / double(levels.back().image.data().size());
    EXPECT_NEAR(last, mean, 1e-6);
  }
}

}  // namespace
}  // namespace rnmbake
