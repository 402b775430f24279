#include "scene/tangents.h"

#include "scene/test_meshes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

void expect_near(const Vec3& actual, const Vec3& expected, const char* what) {
  EXPECT_LT((actual - expected).length(), 2e-6F) << what << ": " << actual << " instead of " << expected;
}

void expect_frames(const TangentFrames& frames, const Vec3& tangent, const Vec3& bitangent,
                   const Vec3& normal) {
  EXPECT_EQ(frames.degenerate_corners, 0U);
  for (const Frame& frame : frames.corners) {
    expect_near(frame.tangent, tangent.normalized(), "tangent");
    expect_near(frame.bitangent, bitangent.normalized(), "bitangent");
    expect_near(frame.normal, normal.normalized(), "normal");
    EXPECT_EQ(frame.sign, frame.normal.cross(frame.tangent).dot(frame.bitangent) > 0 ? 1.0F : -1.0F);
  }
}

std::vector<Vec2> mapped(const std::vector<Vec2>& uv, float a, float b, float c, float d) {
  std::vector<Vec2> result;
  for (const Vec2& p : uv) {
    result.emplace_back(a * p.x + b * p.y, c * p.x + d * p.y);
  }
  return result;
}

TEST(Tangents, OfAPlaneAreItsAxes) {
  expect_frames(tangent_frames(square(), square_uv(), Mat44()), {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
}

TEST(Tangents, TurnWithTheUvs) {
  const float c = std::cos(0.5F), s = std::sin(0.5F);
  // u = c x - s y grows along (c, -s), v = s x + c y along (s, c).
  expect_frames(tangent_frames(square(), mapped(square_uv(), c, -s, s, c), Mat44()), {c, -s, 0}, {s, c, 0},
                {0, 0, 1});
}

TEST(Tangents, DoNotChangeWithTheScaleOfTheUvs) {
  expect_frames(tangent_frames(square(), mapped(square_uv(), 1e-4F, 0, 0, 7), Mat44()), {1, 0, 0}, {0, 1, 0},
                {0, 0, 1});
}

TEST(Tangents, OfMirroredUvsAreLeftHanded) {
  const TangentFrames frames = tangent_frames(square(), mapped(square_uv(), -1, 0, 0, 1), Mat44());
  expect_frames(frames, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  EXPECT_EQ(frames.corners[0].sign, -1.0F);
}

TEST(Tangents, OfAMirroredObjectFollowItsSurface) {
  const TangentFrames frames = tangent_frames(square(), square_uv(), scaled(-1, 1, 1));
  expect_frames(frames, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  EXPECT_EQ(frames.corners[0].sign, -1.0F);
}

TEST(Tangents, OfAnObjectMirroredThroughItsPlaneFaceTheOtherWay) {
  const TangentFrames frames = tangent_frames(square(), square_uv(), scaled(1, 1, -2));
  expect_frames(frames, {1, 0, 0}, {0, 1, 0}, {0, 0, -1});
  EXPECT_EQ(frames.corners[0].sign, -1.0F);
}

TEST(Tangents, OfMirroredUvsOnAMirroredObjectAreRightHanded) {
  const TangentFrames frames = tangent_frames(square(), mapped(square_uv(), -1, 0, 0, 1), scaled(-1, 1, 1));
  expect_frames(frames, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  EXPECT_EQ(frames.corners[0].sign, 1.0F);
}

TEST(Tangents, GoWithARotationAndATranslation) {
  Mat44 matrix;
  matrix.setAxisAngle(Vec3d(1, 0, 0), pi / 2);
  matrix[3][0] = 1e6;
  expect_frames(tangent_frames(square(), square_uv(), matrix), {1, 0, 0}, {0, 0, 1}, {0, -1, 0});
}

/// A slope z = x, scaled by 2 along x: the surface becomes z = x / 2, whose normal is (-1, 0, 2).
TEST(Tangents, OfANonUniformScaleStayPerpendicularToTheScaledSurface) {
  Mesh mesh = square();
  for (Vec3& p : mesh.positions) {
    p.z = p.x;
  }
  mesh.loop_normal.assign(6, Vec3(-1, 0, 1).normalized());
  expect_frames(tangent_frames(mesh, square_uv(), scaled(2, 1, 1)), {2, 0, 1}, {0, 1, 0}, {-1, 0, 2});
}

TEST(Tangents, OfATinyObjectAreAsGood) {
  expect_frames(tangent_frames(square(), square_uv(), scaled(1e-12, 1e-12, 1e-12)), {1, 0, 0}, {0, 1, 0},
                {0, 0, 1});
}

TEST(Tangents, OfAnObjectFlattenedToAPlaneExist) {
  expect_frames(tangent_frames(square(), square_uv(), scaled(1, 1, 0)), {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
}

TEST(Tangents, WithoutUvAreaAreArbitraryButOrthonormal) {
  const TangentFrames frames = tangent_frames(square(), std::vector<Vec2>(6, Vec2(0)), Mat44());
  EXPECT_EQ(frames.degenerate_corners, 6U);
  for (const Frame& frame : frames.corners) {
    EXPECT_NEAR(frame.tangent.length(), 1, 1e-6);
    EXPECT_NEAR(frame.tangent.dot(frame.normal), 0, 1e-6);
  }
}

/// The second triangle has no UV area but shares an edge, with its UVs, with the first.
TEST(Tangents, SpreadToATriangleWithoutUvArea) {
  const std::vector<Vec2> uv{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0.5F, 0.5F}};
  const TangentFrames frames = tangent_frames(square(), uv, Mat44());
  EXPECT_EQ(frames.degenerate_corners, 1U);  // the corner that no good triangle touches
  expect_near(frames.corners[3].tangent, {1, 0, 0}, "tangent");
  expect_near(frames.corners[4].tangent, {1, 0, 0}, "tangent");
}

TEST(Tangents, OfATriangleWithoutAreaComeFromItsNeighbour) {
  const Mesh mesh = triangle_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 2},
                                  std::vector<Vec3>(6, Vec3(0, 0, 1)));
  const TangentFrames frames =
      tangent_frames(mesh, {{0, 0}, {0, 1}, {-1, 0}, {0, 0}, {-1, 0}, {-1, 0}}, Mat44());
  EXPECT_EQ(frames.degenerate_corners, 0U);
  for (const Frame& frame : frames.corners) {
    expect_near(frame.tangent, {0, -1, 0}, "tangent");
  }
}

/// Two triangles of one plane whose UVs are sheared against each other: corners on the shared edge average by
/// their angles (45 degrees each here), the others keep their triangle's own direction.
TEST(Tangents, AverageByAngleOverCornersThatShareEverything) {
  const std::vector<Vec2> uv{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {1, 2}};
  const TangentFrames frames = tangent_frames(square(), uv, Mat44());
  // The second triangle has u = y/2 + 1/2, v = y - x/2 + 1/2: v stays the same along (2, 1).
  const Vec3 first(1, 0, 0), second = frames.corners[5].tangent;
  expect_near(second, Vec3(2, 1, 0).normalized(), "own tangent");
  expect_near(frames.corners[1].tangent, first, "own tangent");
  expect_near(frames.corners[0].tangent, (first + second).normalized(), "shared tangent");
  expect_near(frames.corners[3].tangent, (first + second).normalized(), "shared tangent");
}

TEST(Tangents, AreNotAveragedAcrossAMirrorSeam) {
  // The second triangle has the first one's UVs reflected in the shared diagonal.
  const std::vector<Vec2> uv{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {1, 0}};
  const TangentFrames frames = tangent_frames(square(), uv, Mat44());
  expect_near(frames.corners[0].tangent, {1, 0, 0}, "first");
  expect_near(frames.corners[3].tangent, {0, 1, 0}, "second");
  EXPECT_EQ(frames.corners[0].sign, 1.0F);
  EXPECT_EQ(frames.corners[3].sign, -1.0F);
}

}  // namespace
}  // namespace rnmbake
