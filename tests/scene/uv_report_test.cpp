#include "scene/uv_report.h"

#include "scene/loose_parts.h"
#include "scene/test_meshes.h"

#include <array>

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

/// The square, and each of these triangles on places of its own.
Mesh square_and(const std::vector<std::array<Vec3, 3>>& more) {
  Mesh mesh = square();
  std::vector<Vec3> positions = mesh.positions;
  std::vector<std::uint32_t> corners = mesh.loop_vertex;
  for (const auto& triangle : more) {
    for (const Vec3& p : triangle) {
      corners.push_back(static_cast<std::uint32_t>(positions.size()));
      positions.push_back(p);
    }
  }
  return triangle_mesh(positions, corners, std::vector<Vec3>(corners.size(), Vec3(0, 0, 1)));
}

std::size_t doubled(const std::vector<std::array<Vec3, 3>>& more) {
  const Mesh mesh = square_and(more);
  return report_uv(mesh, std::vector<Vec2>(mesh.loop_vertex.size(), Vec2(0)), scaled(1, -2, 1), 8, 8).doubled;
}

TEST(UvReport, CountsTrianglesOnOthersThatAreSeenFromTheSameSide) {
  const Vec3 a(-1, -1, 0), b(1, -1, 0), c(1, 1, 0), d(-1, 1, 0);  // of the square
  EXPECT_EQ(doubled({}), 0U);
  EXPECT_EQ(doubled({{a, b, c}}), 1U);
  EXPECT_EQ(doubled({{b, c, a}, {c, a, b}, {d, a, c}}), 3U) << "wherever they begin";
  EXPECT_EQ(doubled({{c, b, a}, {d, c, a}}), 0U) << "back to back";
  EXPECT_EQ(doubled({{c, b, a}, {b, a, c}}), 1U) << "one of two on the back";
  EXPECT_EQ(doubled({{a, b, d}, {a, b, Vec3(1, 1, 1e-6F)}}), 0U) << "two corners in common";
  EXPECT_EQ(doubled({{a, b, Vec3(1, 1, -0.0F)}}), 1U);
  EXPECT_EQ(doubled({{a, a, b}, {a, a, b}}), 0U) << "without area";
}

TEST(UvReport, ADoubleInAnotherPartIsNotCounted) {
  const Vec3 a(-1, -1, 0), b(1, -1, 0), c(1, 1, 0);
  const Mesh mesh = square_and({{a, b, c}});
  const std::vector<Vec2> uv(mesh.loop_vertex.size(), Vec2(0));
  EXPECT_EQ(report_uv(mesh, {0, 2}, uv, {}, 8, 8).doubled, 1U);
  EXPECT_EQ(report_uv(mesh, {1, 2}, uv, {}, 8, 8).doubled, 0U);
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
