#include "scene/surface.h"

#include "bake/fixture.h"
#include "scene/test_meshes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rnmbake {
namespace {

const std::vector<std::uint32_t> both_triangles{0, 1};

Mat44 moved(const Vec3d& by, double scale) {
  Mat44 matrix = scaled(scale, scale, scale);
  matrix[3][0] = by.x;
  matrix[3][1] = by.y;
  matrix[3][2] = by.z;
  return matrix;
}

Vec3 winding(const SurfaceTriangle& triangle) {
  const auto& k = triangle.corners;
  return (k[1].position - k[0].position).cross(k[2].position - k[0].position).normalized();
}

double step_at(double distance) {
  return double(std::nextafter(float(distance), 1e30F)) - double(float(distance));
}

float height_of(const Mat44& to_world) {
  const Surface surface = square_surface(to_world);
  EXPECT_EQ(surface.triangles.size(), 2U);
  return surface.triangles.empty() ? 0.0F : surface.triangles[0].height;
}

TEST(Surface, StandsOffAlongTheFaceNormal) {
  for (const double distance : {0.0, 10.0, 1000.0, 1e5}) {
    const Surface surface = square_surface(moved({0.5 * distance, 0, distance}, 1));
    ASSERT_EQ(surface.triangles.size(), 2U);
    for (const SurfaceTriangle& triangle : surface.triangles) {
      EXPECT_NEAR(triangle.normal.z, 1, 1e-6);
      EXPECT_GE(triangle.height, 4 * step_at(distance));
      EXPECT_LE(triangle.height, 8 * step_at(distance) + 2e-6);
      for (const SurfaceCorner& corner : triangle.corners)
        EXPECT_NEAR(corner.position.z, distance + double(triangle.height), step_at(distance));
    }
  }
}

TEST(Surface, OnlyCoordinatesAcrossAFaceLiftIt) {
  EXPECT_EQ(height_of(moved({1e5, -1e5, 0}, 1)), height_of(Mat44()));
  Mat44 upright;
  upright.setAxisAngle(Imath::V3d(0, 1, 0), pi / 2);
  upright[3][0] = 1000;
  EXPECT_NEAR(height_of(upright), 8 * 1000 * 0x1p-24, 1e-5);
}

TEST(Surface, CornersStayInPlaceAtAnySize) {
  for (const double scale : {1e-4, 1.0, 1e4}) {
    const Surface surface = square_surface(scaled(scale, scale, scale));
    const Vec2 places[] = {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1)};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = surface.triangles[0].corners[k].position / static_cast<float>(scale);
      EXPECT_LT((Vec2(p.x, p.y) - places[k]).length(), 1e-6) << scale;
      EXPECT_GT(p.z, 0) << scale;
      EXPECT_LT(p.z, 2e-6) << scale;
    }
  }
}

/// A level floor whose mesh is tilted, or lies far from its own origin: where Cycles turns rays to the mesh,
/// those have the world's coordinates, mixed.
TEST(Surface, KnowsWhatTheObjectsMatrixMixes) {
  Mat44 tilt;
  tilt.setAxisAngle(Imath::V3d(1, 1, 1).normalized(), 0.4);
  Mesh tilted = square();
  for (Vec3& p : tilted.positions) p = Vec3(Vec3d(p) * tilt);
  Mat44 level = tilt.transposed();
  level[3][0] = 1000;
  const Surface surface =
      make_surface(tilted, both_triangles, square_uv(), tangent_frames(tilted, square_uv(), level), level);
  EXPECT_NEAR(surface.triangles[0].normal.z, 1, 1e-6);
  EXPECT_GT(surface.triangles[0].height, 1e-4);

  Mesh off = square();
  for (Vec3& p : off.positions) p.z += 5000;
  const Mat44 back = moved({0, 0, -5000}, 1);
  const Surface pivoted =
      make_surface(off, both_triangles, square_uv(), tangent_frames(off, square_uv(), back), back);
  EXPECT_NEAR(pivoted.triangles[0].corners[0].position.z, 0, 0.01);
  EXPECT_GT(pivoted.triangles[0].height, 4 * step_at(5000));
}

TEST(Surface, OfAMirroredObjectKeepsItsOutside) {
  const Surface surface = square_surface(scaled(-1, 1, 1));
  ASSERT_EQ(surface.triangles.size(), 2U);
  for (const SurfaceTriangle& triangle : surface.triangles) {
    EXPECT_NEAR(triangle.normal.z, 1, 1e-6);
    EXPECT_NEAR(winding(triangle).z, 1, 1e-6);
    for (const SurfaceCorner& corner : triangle.corners) EXPECT_NEAR(corner.frame.normal.z, 1, 1e-6);
    // u grows towards +x of the mesh, which the mirror turned round
    for (const SurfaceCorner& corner : triangle.corners)
      EXPECT_NEAR(corner.uv.x, (1 - corner.position.x) / 2, 1e-3);
  }
}

TEST(Surface, WindsAsItsNormalSays) {
  for (const Mat44& matrix : {scaled(1, 1, 1), scaled(1, -2, 3), scaled(-1, -1, -1), scaled(2, 3, -1)}) {
    for (const SurfaceTriangle& triangle : square_surface(matrix).triangles)
      EXPECT_NEAR(winding(triangle).dot(triangle.normal), 1, 1e-5);
  }
}

TEST(Surface, LeavesOutTrianglesWithoutArea) {
  const Mesh mesh = triangle_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}}, {0, 1, 2, 0, 1, 3, 1, 1, 2},
                                  std::vector<Vec3>(9, Vec3(0, 0, 1)));
  const std::vector<Vec2> uv(9, Vec2(0.5F, 0.5F));
  const Mat44 id;
  const Surface surface = make_surface(mesh, {0, 1, 2}, uv, tangent_frames(mesh, uv, id), id);
  EXPECT_EQ(surface.triangles.size(), 1U);
  EXPECT_EQ(surface.degenerate, 2U);
  EXPECT_EQ(square_surface(scaled(0, 1, 1)).degenerate, 2U);
}

TEST(Surface, TakesOnlyTheSubset) {
  const Mesh mesh = square();
  const Mat44 id;
  const Surface surface = make_surface(mesh, {1}, square_uv(), tangent_frames(mesh, square_uv(), id), id);
  ASSERT_EQ(surface.triangles.size(), 1U);
  EXPECT_EQ(surface.triangles[0].corners[2].uv, Vec2(0, 1));
}

TEST(Surface, IsFiniteWhereFloatsCannotTellItsCornersApart) {
  for (const SurfaceTriangle& triangle : square_surface(moved({1e4, 1e4, 0}, 1e-6)).triangles) {
    for (const SurfaceCorner& corner : triangle.corners)
      EXPECT_TRUE(std::isfinite(corner.position.x) && std::isfinite(corner.position.z));
  }
}

}  // namespace
}  // namespace rnmbake
