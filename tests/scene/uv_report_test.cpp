#include "scene/uv_report.h"

#include "scene/loose_parts.h"
#include "scene/test_meshes.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

UvReport report(const std::vector<Vec2>& uv, const Mat44& to_world = {}) {
  return report_uv(square(), uv, to_world, 64, 32);
}

std::vector<Vec2> placed(std::vector<Vec2> uv, const Vec2& scale, const Vec2& offset) {
  for (Vec2& p : uv) {
    p = p * scale + offset;
  }
  return uv;
}

TEST(UvReport, FindsNothingWrongWithAFullSquare) {
  const UvReport found = report(square_uv());
  EXPECT_TRUE(found.clean());
  EXPECT_EQ(found.triangles, 2U);
  EXPECT_DOUBLE_EQ(found.uv_area, 1);
  EXPECT_DOUBLE_EQ(found.world_area, 4);
  EXPECT_EQ(found.covered_texels, 64U * 32U);
  EXPECT_EQ(found.overlap_texels, 0U);
  EXPECT_EQ(found.charts, 1U);
  EXPECT_EQ(found.mirrored_charts, 0U);
  EXPECT_EQ(found.degenerate_uv + found.degenerate_world, 0U);
  EXPECT_DOUBLE_EQ(found.density.median, std::sqrt(64 * 32 / 4.0));
}

TEST(UvReport, MeasuresDensityInTheWorld) {
  Mat44 to_world;
  to_world.setScale(Vec3d(4, -1, 1));
  const UvReport found = report(square_uv(), to_world);
  EXPECT_DOUBLE_EQ(found.world_area, 16);
  EXPECT_DOUBLE_EQ(found.density.min, std::sqrt(64 * 32 / 16.0));
}

TEST(UvReport, CountsOverlaps) {
  const UvReport found = report({{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 0}, {1, 1}});
  EXPECT_EQ(found.overlap_texels, found.covered_texels);
  EXPECT_EQ(found.charts, 1U);  // they share the UV of a vertex
  EXPECT_FALSE(found.clean());
}

TEST(UvReport, MeasuresWhatLiesOutside) {
  const UvReport found = report(placed(square_uv(), {1, 1}, {0.5F, 0}));
  EXPECT_EQ(found.outside_corners, 3U);
  EXPECT_NEAR(found.outside_texels, 64 * 32 / 2.0, 1e-3);
  EXPECT_EQ(found.covered_texels, 64U * 32U / 2U);
}

TEST(UvReport, CountsMirroredCharts) {
  const UvReport found = report(placed(square_uv(), {-1, 1}, {1, 0}));
  EXPECT_EQ(found.charts, 1U);
  EXPECT_EQ(found.mirrored_charts, 1U);
  EXPECT_TRUE(found.clean());
}

TEST(UvReport, SeesUvsThatWereNeverMade) {
  const UvReport found = report(std::vector<Vec2>(6, Vec2(0)));
  EXPECT_TRUE(found.all_zero);
  EXPECT_EQ(found.degenerate_uv, 2U);
  EXPECT_EQ(found.covered_texels, 0U);
}

TEST(UvReport, TellsDegenerateFacesFromDegenerateUvs) {
  Mesh mesh = square();
  mesh.positions[3] = {0, 0, 0};  // on the diagonal
  EXPECT_EQ(report_uv(mesh, square_uv(), {}, 8, 8).degenerate_world, 1U);
  EXPECT_EQ(report_uv(mesh, square_uv(), {}, 8, 8).degenerate_uv, 0U);
}

TEST(UvReport, OfNoFacesIsEmpty) {
  const UvReport found = report_uv(Mesh{}, {}, {}, 8, 8);
  EXPECT_EQ(found.triangles, 0U);
  EXPECT_FALSE(found.all_zero);
}

TEST(LooseParts, ShareNoVertex) {
  const Mesh mesh = triangle_mesh(std::vector<Vec3>(9, Vec3(0)), {6, 7, 8, 0, 1, 2, 2, 3, 4, 6, 8, 5},
                                  std::vector<Vec3>(12, Vec3(0, 0, 1)));
  EXPECT_EQ(loose_parts(mesh), (std::vector<std::uint32_t>{0, 1, 1, 0}));
}

}  // namespace
}  // namespace rnmbake
