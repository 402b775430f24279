#include "bake/clip.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Area in weight space, as a share of the whole triangle.
double share(const std::vector<Weights>& triangles) {
  double sum = 0;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const Weights a = triangles[i + 1] - triangles[i], b = triangles[i + 2] - triangles[i];
    sum += double(a.y) * b.z - double(a.z) * b.y;
  }
  return sum;
}

std::array<float, 3> negated(const std::array<float, 3>& v) {
  return {-v[0], -v[1], -v[2]};
}

TEST(Clip, KeepsAllWhereTheFunctionIsPositive) {
  EXPECT_EQ(clip(whole_triangle(), {1, 2, 3}), whole_triangle());
}

TEST(Clip, KeepsNothingWhereItIsNegative) {
  EXPECT_TRUE(clip(whole_triangle(), {-1, -2, -3}).empty());
}

TEST(Clip, HalvesAlongAMedian) {
  const WeightPolygon half = clip(whole_triangle(), {0, 1, -1});
  EXPECT_EQ(half.size(), 3U);
  EXPECT_NEAR(share(triangulate(half)), 0.5, 1e-6);
}

TEST(Clip, LeavesAQuadWhereOneCornerIsCutOff) {
  const WeightPolygon rest = clip(whole_triangle(), {-1, 1, 1});
  EXPECT_EQ(rest.size(), 4U);
  EXPECT_NEAR(share(triangulate(rest)), 0.75, 1e-6);
}

TEST(Clip, DropsWhatIsOnlyAPointOrAnEdge) {
  EXPECT_TRUE(clip(whole_triangle(), {0, -1, -1}).empty());
  EXPECT_NEAR(share(triangulate(clip(whole_triangle(), {0, 0, -1}))), 0, 1e-7);
}

TEST(Clip, BothSidesOfRandomCutsSumUp) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const std::array<float, 3> values{uniform(random), uniform(random), uniform(random)};
    const double kept = share(triangulate(clip(whole_triangle(), values)));
    const double rest = share(triangulate(clip(whole_triangle(), negated(values))));
    ASSERT_GE(kept, -1e-6);
    ASSERT_GE(rest, -1e-6);
    ASSERT_NEAR(kept + rest, 1, 2e-6) << values[0] << " " << values[1] << " " << values[2];
  }
}

TEST(Clip, KeepsTheValuesOfWhatItCarriesOnTheRightSide) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const std::array<float, 3> values{uniform(random), uniform(random), uniform(random)};
    for (const Weights& w : clip(whole_triangle(), values)) {
      ASSERT_GE(w.x * values[0] + w.y * values[1] + w.z * values[2], -1e-6);
      ASSERT_NEAR(w.x + w.y + w.z, 1, 1e-6);
    }
  }
}

TEST(Triangulate, PartsShareTheAreaAndTheWinding) {
  const WeightPolygon quad = clip(whole_triangle(), {-1, 1, 2});
  for (const int parts : {1, 2, 3, 7, 16}) {
    const std::vector<Weights> triangles = triangulate(quad, parts);
    ASSERT_EQ(triangles.size(), 3U * 2 * static_cast<std::size_t>(parts * parts));
    EXPECT_NEAR(share(triangles), share(triangulate(quad)), 1e-5);
    for (std::size_t i = 0; i < triangles.size(); i += 3)
      ASSERT_GT(share({triangles[i], triangles[i + 1], triangles[i + 2]}), 0);
  }
}

TEST(Triangulate, OfNothingIsNothing) {
  EXPECT_TRUE(triangulate({}, 4).empty());
}

}  // namespace
}  // namespace rnmbake
