#include "scene/surface.h"

#include "bake/fixture.h"
#include "scene/test_meshes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rnmbake {
namespace {

const std::vector<std::uint32_t> both_triangles{0, 1};

Surface square_surface(const Mat44& to_world) {
  const Mesh mesh = square();
  return make_surface(mesh, both_triangles, square_uv(), tangent_frames(mesh, square_uv(), to_world),
                      to_world);
}

Mat44 scaled(double x, double y, double z) {
  Mat44 matrix;
  matrix.setScale(Imath::V3d(x, y, z));
  return matrix;
}

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

TEST(Lift, IsManyFloatStepsAtAnyDistance) {
  for (const float distance : {0.0F, 1.0F, 13.0F, 126.0F, 1260.0F, 1e6F}) {
    const float step = std::nextafter(distance, 2e9F) - distance;
    EXPECT_GT(lift(Vec3(distance, 0, 0), 1), 8 * double(step)) << distance;
    EXPECT_LT(lift(Vec3(distance, 0, 0), 1), std::max(2e-5, 1e-5 * double(distance))) << distance;
  }
}

TEST(Lift, IsSmallBesideASmallObject) {
  EXPECT_LE(lift(Vec3(0), 1e-3), 1e-6 + 1e-12);
  EXPECT_LT(lift(Vec3(0), 5e-3), lift(Vec3(0), 1));
  EXPECT_GT(lift(Vec3(0), 0), 0);
}

TEST(Surface, StandsOffAlongTheFaceNormal) {
  for (const double distance : {0.0, 10.0, 1000.0}) {
    const Surface surface = square_surface(moved({distance, 0, 0}, 1));
    ASSERT_EQ(surface.triangles.size(), 2U);
    for (const SurfaceTriangle& triangle : surface.triangles) {
      EXPECT_NEAR(triangle.normal.z, 1, 1e-6);
      for (const SurfaceCorner& corner : triangle.corners) {
        EXPECT_GT(corner.position.z, 0);
        EXPECT_LT(corner.position.z, 1e-5 + 5e-6 * distance);
      }
    }
  }
}

TEST(Surface, DrawnInCornersStayInsideTheTriangle) {
  const std::array<Vec2, 3> places[] = {{Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1)},
                                        {Vec2(-1, -1), Vec2(1, 1), Vec2(-1, 1)}};
  for (const double scale : {1e-4, 1e-2, 1.0, 100.0}) {
    const Surface surface = square_surface(scaled(scale, scale, scale));
    for (std::size_t t = 0; t < 2; ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3& p = surface.triangles[t].corners[c].position;
        const Vec2 moved_by = Vec2(p.x, p.y) / static_cast<float>(scale) - places[t][c];
        const float to_middle = std::sqrt(20.0F) / 3;  // of the longest way, from a sharp corner
        EXPECT_LE(moved_by.length(), 0.081F * to_middle) << scale;
        for (std::size_t e = 0; e < 3; ++e) {
          const Vec2 from = places[t][e], edge = places[t][(e + 1) % 3] - from;
          const Vec2 to = Vec2(p.x, p.y) / static_cast<float>(scale) - from;
          EXPECT_GT(edge.x * to.y - edge.y * to.x, 0) << "corner " << c << " edge " << e << " at " << scale;
        }
      }
    }
  }
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
