#include "bake/uv_problems.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

std::vector<UvProblem> doubled(std::size_t count, std::size_t triangles) {
  UvReport report;
  report.triangles = triangles;
  report.doubled = count;
  return uv_problems(report, 64, 64);
}

TEST(UvProblems, DoubledTrianglesAreOneFromTwoPercentOn) {
  EXPECT_TRUE(doubled(0, 0).empty());
  EXPECT_TRUE(doubled(0, 100).empty());
  EXPECT_TRUE(doubled(2, 100).empty());
  ASSERT_EQ(doubled(3, 100).size(), 1U);
  EXPECT_EQ(spoken(doubled(3, 100)[0]), "3 triangles lie on others");
  EXPECT_EQ(spoken(doubled(1, 2)[0]), "1 triangle lies on another");
  EXPECT_STRNE(remedy(doubled(1, 2)[0].kind), "");
}

TEST(UvProblems, OfASizeAskedForIsTheSide) {
  UvReport report;
  EXPECT_TRUE(uv_problems(report, 64, 64).empty());
  ASSERT_EQ(uv_problems(report, 64, 200).size(), 1U);
  EXPECT_EQ(spoken(uv_problems(report, 64, 200)[0]), "texels_per_unit wants 200 x 200");
}

TEST(UvProblems, TrianglesInATileAreNotAlsoOutside) {
  UvReport report;
  report.outside_texels = 7;
  EXPECT_EQ(spoken(uv_problems(report, 64, 64).at(0)), "7 texels outside [0,1]");
  report.tile_triangles = 1;
  ASSERT_EQ(uv_problems(report, 64, 64).size(), 1U);
  EXPECT_EQ(spoken(uv_problems(report, 64, 64)[0]), "1 triangle in another UDIM tile");
}

}  // namespace
}  // namespace rnmbake
