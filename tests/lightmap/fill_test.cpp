#include "lightmap/fill.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

struct Case {
  FloatImage image, coverage;
};

Case random_case(int width, int height, double share, unsigned seed) {
  Case c{FloatImage(width, height, 3), FloatImage(width, height, 1)};
  std::mt19937 random(seed);
  std::bernoulli_distribution is_covered(share);
  std::uniform_real_distribution<float> uniform(0, 10);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!is_covered(random)) continue;
      c.coverage.texel(x, y)[0] = 1;
      for (float& value : c.image.texel(x, y)) value = uniform(random);
    }
  }
  return c;
}

/// The definition, word for word: every pass looks at all texels of the pass before.
FloatImage by_definition(Case c, int passes) {
  for (int pass = 0; pass < passes; ++pass) {
    const Case before = c;
    for (int y = 0; y < c.image.height(); ++y) {
      for (int x = 0; x < c.image.width(); ++x) {
        if (before.coverage.texel(x, y)[0] != 0) continue;
        std::array<double, 3> sum{};
        int count = 0;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            const int nx = x + dx, ny = y + dy;
            if (nx < 0 || ny < 0 || nx >= c.image.width() || ny >= c.image.height()) continue;
            if (before.coverage.texel(nx, ny)[0] == 0) continue;
            ++count;
            for (std::size_t k = 0; k < 3; ++k) sum[k] += before.image.texel(nx, ny)[k];
          }
        }
        if (count == 0) continue;
        c.coverage.texel(x, y)[0] = 1;
        for (std::size_t k = 0; k < 3; ++k) c.image.texel(x, y)[k] = static_cast<float>(sum[k] / count);
      }
    }
  }
  return c.image;
}

TEST(Dilate, AgreesWithTheDefinitionOnRandomMasks) {
  unsigned seed = 0;
  for (const auto& [width, height] :
       {std::pair{1, 1}, {1, 17}, {17, 1}, {2, 2}, {31, 7}, {7, 31}, {24, 24}}) {
    for (const double share : {0.0, 0.03, 0.3, 0.9, 1.0}) {
      for (const int passes : {0, 1, 2, 5, 40}) {
        Case c = random_case(width, height, share, ++seed);
        const FloatImage expected = by_definition(c, passes);
        dilate(c.image, c.coverage, passes);
        for (std::size_t i = 0; i < expected.data().size(); ++i)
          ASSERT_NEAR(c.image.data()[i], expected.data()[i], 1e-4)
              << width << "x" << height << " " << share << " " << passes;
      }
    }
  }
}

TEST(Dilate, NeverChangesCoveredTexelsNorTheCoverage) {
  Case c = random_case(40, 23, 0.4, 7);
  const Case before = c;
  dilate(c.image, c.coverage, 3);
  EXPECT_EQ(c.coverage.data(), before.coverage.data());
  for (int y = 0; y < 23; ++y) {
    for (int x = 0; x < 40; ++x) {
      if (c.coverage.texel(x, y)[0] == 0) continue;
      for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(c.image.texel(x, y)[k], before.image.texel(x, y)[k]);
    }
  }
}

TEST(Dilate, ReachesExactlyAsFarAsAsked) {
  for (const bool is_row : {true, false}) {
    FloatImage image(is_row ? 9 : 1, is_row ? 1 : 9, 1), coverage(image.width(), image.height(), 1);
    image.data()[0] = 5;
    coverage.data()[0] = 1;
    dilate(image, coverage, 3);
    EXPECT_EQ(image.data(), (std::vector<float>{5, 5, 5, 5, 0, 0, 0, 0, 0}));
  }
}

TEST(Dilate, EverywhereReachesTheFurthestCorner) {
  for (const auto& [width, height] : {std::pair{7, 3}, {3, 7}, {1, 6}}) {
    FloatImage image(width, height, 1), coverage(width, height, 1);
    image.data()[0] = 5;
    coverage.data()[0] = 1;
    dilate_everywhere(image, coverage);
    EXPECT_EQ(image.data(), std::vector<float>(image.texels(), 5)) << width << "x" << height;
  }
  FloatImage image(2, 2, 1), nothing(2, 2, 1);
  image.data() = {1, 2, 3, 4};
  dilate_everywhere(image, nothing);
  EXPECT_EQ(image.data(), (std::vector<float>{1, 2, 3, 4}));
}

TEST(Dilate, NegativePassesDoNothing) {
  Case c = random_case(5, 5, 0.5, 1);
  const auto before = c.image.data();
  dilate(c.image, c.coverage, -1);
  EXPECT_EQ(c.image.data(), before);
}

TEST(Dilate, NaNStaysWhereItIs) {
  FloatImage image(4, 1, 1), coverage(4, 1, 1);
  image.data() = {2, nan_value, 0, 0};
  coverage.data() = {1, 1, 0, 0};
  dilate(image, coverage, 4);
  EXPECT_TRUE(std::isnan(image.data()[1]));
  EXPECT_EQ(image.data()[2], 0);  // its only covered neighbour is not a number
}

TEST(FillFromNeighbours, CountsAndStopsAtWhatIsNotFillable) {
  FloatImage image(5, 1, 1);
  image.data() = {1, 0, 0, 0, 3};
  EXPECT_EQ(fill_from_neighbours(image, {1, 0, 0, 0, 1}, {0, 1, 0, 1, 0}, 9), 2U);
  EXPECT_EQ(image.data(), (std::vector<float>{1, 1, 0, 3, 3}));
}

}  // namespace
}  // namespace rnmbake
