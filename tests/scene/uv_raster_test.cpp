#include "scene/uv_raster.h"

#include "scene/test_meshes.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

std::size_t covered(const UvRaster& raster) {
  return static_cast<std::size_t>(
      std::count_if(raster.layers.begin(), raster.layers.end(), [](auto layers) { return layers > 0; }));
}

std::uint16_t most_layers(const UvRaster& raster) {
  return *std::max_element(raster.layers.begin(), raster.layers.end());
}

class FullSquare : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(FullSquare, CoversEveryTexelOnce) {
  const auto [width, height] = GetParam();
  const UvRaster raster = rasterize(square_uv(), width, height);
  EXPECT_EQ(covered(raster), raster.owners.size());
  EXPECT_EQ(most_layers(raster), 1);
}

INSTANTIATE_TEST_SUITE_P(Sizes, FullSquare,
                         testing::Values(std::pair{1, 1}, std::pair{4, 4}, std::pair{64, 64},
                                         std::pair{63, 65}, std::pair{256, 16}, std::pair{5, 333},
                                         std::pair{1024, 1024}));

/// A grid whose lines run through texel centres, where ties are most common.
TEST(UvRaster, GivesTexelsOnSharedEdgesToOneTriangle) {
  constexpr int cells = 16;
  std::vector<Vec2> uv;
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      const auto at = [&](int i, int j) {
        return Vec2((static_cast<float>(x + i) + 0.5F) / cells, (static_cast<float>(y + j) + 0.5F) / cells);
      };
      uv.insert(uv.end(), {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  const UvRaster raster = rasterize(uv, cells, cells);
  EXPECT_EQ(most_layers(raster), 1);
}

TEST(UvRaster, TilesRandomFansWithoutGapsOrOverlaps) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> position(0.05F, 0.95F);
  for (int round = 0; round < 50; ++round) {
    const Vec2 centre(position(random), position(random));
    const std::vector<Vec2> rim{{0, 0}, {position(random), 0}, {1, 0}, {1, position(random)},
                                {1, 1}, {position(random), 1}, {0, 1}, {0, position(random)}};
    std::vector<Vec2> uv;
    for (std::size_t i = 0; i < rim.size(); ++i) {
      uv.insert(uv.end(), {centre, rim[i], rim[(i + 1) % rim.size()]});
    }
    const UvRaster raster = rasterize(uv, 97, 61);
    EXPECT_EQ(covered(raster), raster.owners.size());
    EXPECT_EQ(most_layers(raster), 1);
  }
}

TEST(UvRaster, PutsRowZeroOnTop) {
  const UvRaster raster = rasterize({{0, 0.5F}, {1, 0.5F}, {0, 1.5F}}, 2, 2);  // only v > 0.5
  EXPECT_EQ(raster.at(0, 0).triangle, 0);
  EXPECT_EQ(raster.at(0, 1).triangle, -1);
}

TEST(UvRaster, GivesTheLastTriangleTheTexelAndCountsLayers) {
  std::vector<Vec2> uv = square_uv();
  uv.insert(uv.end(), {{0, 0}, {1, 0}, {1, 1}});
  const UvRaster raster = rasterize(uv, 8, 8);
  EXPECT_EQ(raster.at(7, 7).triangle, 2);
  EXPECT_EQ(raster.layers[7 * 8 + 7], 2);
  EXPECT_EQ(raster.at(0, 0).triangle, 1);
  EXPECT_EQ(raster.layers[0], 1);
}

TEST(UvRaster, InterpolatesToTheTexelsCentre) {
  const std::vector<Vec2> uv = square_uv();
  const UvRaster raster = rasterize(uv, 16, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      const TexelOwner& owner = raster.at(x, y);
      const Vec2* c = &uv[std::size_t(3) * static_cast<std::size_t>(owner.triangle)];
      const Vec2 centre = c[0] * (1 - owner.b1 - owner.b2) + c[1] * owner.b1 + c[2] * owner.b2;
      // Centres on the diagonal are clamped to it: the nudge is 0.001 texels along x, 0.002 along y.
      EXPECT_NEAR(centre.x, (static_cast<float>(x) + 0.5F) / 16, 0.003 / 16);
      EXPECT_NEAR(centre.y, 1 - (static_cast<float>(y) + 0.5F) / 8, 0.003 / 8);
    }
  }
}

TEST(UvRaster, ClipsWhatLiesOutside) {
  const UvRaster raster = rasterize({{-3, -3}, {5, -3}, {-3, 5}, {2, 2}, {3, 2}, {2, 3}}, 32, 32);
  EXPECT_EQ(covered(raster), 32U * 32U);
  EXPECT_EQ(most_layers(raster), 1);
  EXPECT_EQ(covered(rasterize({{-1e30F, 0}, {1e30F, 0}, {0, 1e30F}}, 8, 8)), 64U);
  EXPECT_EQ(covered(rasterize({{1.5F, 0}, {2, 0}, {2, 1}}, 8, 8)), 0U);
}

TEST(UvRaster, SkipsSliversBetweenCentres) {
  // One texel is 0.125 wide; centres lie at 0.0625 + k 0.125.
  EXPECT_EQ(covered(rasterize({{0.07F, 0}, {0.17F, 0}, {0.12F, 1}}, 8, 8)), 0U);
  EXPECT_EQ(covered(rasterize({{0.05F, 0}, {0.08F, 0}, {0.0625F, 1}}, 8, 8)), 8U);
  EXPECT_EQ(covered(rasterize({{0, 0}, {1, 1}, {0.5F, 0.5F}}, 8, 8)), 0U);  // no area
}

TEST(UvRaster, CountsTexelsAsTheAreaSays) {
  const UvRaster raster = rasterize({{0.1F, 0.1F}, {0.9F, 0.2F}, {0.3F, 0.8F}}, 1000, 500);
  const double area = 0.5 * (0.8 * 0.7 - 0.1 * 0.2);
  // Each of 350 rows is rounded at both ends, which is a variance of 1/12 each.
  EXPECT_NEAR(static_cast<double>(covered(raster)), area * 500000, 4.5 * std::sqrt(350 * 2 / 12.0));
}

}  // namespace
}  // namespace rnmbake
