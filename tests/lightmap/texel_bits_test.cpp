#include "lightmap/texel_bits.h"

#include "lightmap/touched.h"

#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(TexelBits, AreSetOneByOne) {
  TexelBits bits(130, 3);
  for (const int x : {0, 63, 64, 129}) bits.set(x, 1);
  EXPECT_EQ(bits.count(), 4U);
  EXPECT_TRUE(bits.at(129, 1));
  EXPECT_FALSE(bits.at(129, 0));
  EXPECT_FALSE(bits.at(128, 1));
}

TEST(TexelBits, GrowByTexelsAlongBothAxes) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> one_in(0, 40);
  TexelBits bits(70, 40);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 70; ++x)
      if (one_in(random) == 0) bits.set(x, y);
  }
  for (const int texels : {0, 1, 3}) {
    const TexelBits all = grown(bits, texels);
    ASSERT_EQ(all.width(), 70 + 2 * texels);
    ASSERT_EQ(all.height(), 40 + 2 * texels);
    for (int y = 0; y < all.height(); ++y) {
      for (int x = 0; x < all.width(); ++x) {
        bool near = false;
        for (int v = std::max(y - 2 * texels, 0); v <= std::min(y, 39); ++v) {
          for (int u = std::max(x - 2 * texels, 0); u <= std::min(x, 69); ++u) near = near || bits.at(u, v);
        }
        ASSERT_EQ(all.at(x, y), near) << x << ", " << y << " by " << texels;
      }
    }
  }
}

/// Texels that hold one of many points of the triangle.
TexelBits sampled(const Vec2& a, const Vec2& b, const Vec2& c, int side) {
  TexelBits texels(side, side);
  constexpr int steps = 200;
  for (int i = 0; i <= steps; ++i) {
    for (int k = 0; i + k <= steps; ++k) {
      const Vec2 uv = a + (b - a) * (float(i) / steps) + (c - a) * (float(k) / steps);
      texels.set(std::clamp(int(uv.x * float(side)), 0, side - 1),
                 std::clamp(int((1 - uv.y) * float(side)), 0, side - 1));
    }
  }
  return texels;
}

TEST(Touched, AreAllThatHoldAPointOfATriangle) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(0.05F, 0.95F);
  constexpr int side = 16;
  for (int i = 0; i < 200; ++i) {
    const Vec2 a(place(random), place(random)), b(place(random), place(random));
    const Vec2 c = i % 2 == 0 ? Vec2(place(random), place(random)) : b + Vec2(0.003F, 0.002F);  // a sliver
    TexelBits texels(side, side);
    set_touched({a, b, c}, texels);
    const TexelBits some = sampled(a, b, c, side);
    const TexelBits around = grown(some, 1);
    std::size_t missed = 0;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        if (some.at(x, y) && !texels.at(x, y)) ++missed;
        if (!texels.at(x, y)) continue;
        EXPECT_TRUE(around.at(x + 1, y + 1)) << "none of it near " << x << ", " << y;
      }
    }
    EXPECT_LE(missed, 2U) << "corners that reach in by less than rounding";
  }
}

TEST(Touched, LeaveOutNeighboursOfAnEdgeOnABorder) {
  TexelBits texels(4, 4);
  set_touched(
      {{0.25F, 0.25F}, {0.75F, 0.25F}, {0.75F, 0.75F}, {0.25F, 0.25F}, {0.75F, 0.75F}, {0.25F, 0.75F}},
      texels);
  EXPECT_EQ(texels.count(), 4U);
  EXPECT_TRUE(texels.at(1, 1) && texels.at(2, 1) && texels.at(1, 2) && texels.at(2, 2));
}

TEST(Touched, HaveOneForWhatIsAPoint) {
  TexelBits texels(8, 8);
  set_touched({{0.4F, 0.9F}, {0.4F, 0.9F}, {0.4F, 0.9F}}, texels);
  EXPECT_EQ(texels.count(), 1U);
  EXPECT_TRUE(texels.at(3, 0));
}

TEST(Touched, ClipWhatLiesOutside) {
  TexelBits texels(8, 8);
  set_touched({{-3, -3}, {4, -3}, {-3, 4}}, texels);
  EXPECT_GT(texels.count(), 0U);
  set_touched({{5, 5}, {6, 5}, {5, 6}}, texels);
  EXPECT_FALSE(texels.at(7, 0));
}

}  // namespace
}  // namespace rnmbake
