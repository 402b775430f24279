#include "bake/fences.h"

#include "bake/fixture.h"
#include "scene/test_meshes.h"

#include <algorithm>

namespace rnmbake {
namespace {

LightBall sun(const Vec3d& towards, double radius = 0) {
  return {true, towards.normalized(), radius};
}

std::vector<Fence> fences(const Surface& surface, const LightBall& light) {
  return make_fences(surface, {light}, Vec2(16, 16)).strips;
}

/// Over the plane z = height of the square.
double top(const Fence& fence) {
  double z = -1;
  for (const Vec3& corner : fence.corners) z = std::max(z, double(corner.z));
  return z;
}

TEST(Fences, StandOnlyWhereLightRunsAlongAFace) {
  EXPECT_TRUE(fences(square_surface(), sun({1, 0, 0.01})).empty());
  EXPECT_TRUE(fences(square_surface(), sun({1, 0, 1e-5})).empty());
  EXPECT_TRUE(fences(square_surface(), sun({1, 0, -1})).empty());
  EXPECT_FALSE(fences(square_surface(), sun({1, 0, 1e-5}, 1e-4)).empty()) << "some of it is below";
  EXPECT_TRUE(fences(square_surface(), sun({1, 0, 0.1}, 0.05)).empty());
}

TEST(Fences, StandOnTheRimTowardsTheLightAndNotWhereTheFaceGoesOn) {
  for (const double height : {1e-7, 0.0, -1e-7, -1e-4}) {
    const auto found = fences(square_surface(), sun({1, 0, height}));
    ASSERT_EQ(found.size(), 1U) << height;  // not on the diagonal
    for (const Vec3& corner : found[0].corners) EXPECT_NEAR(corner.x, 1, 1e-5);
    EXPECT_EQ(found[0].up, Vec3(0, 0, 1));
    EXPECT_GT(top(found[0]), square_surface().triangles[0].height + 2 * grazing_sine) << "from the far end";
    EXPECT_LT(top(found[0]), 1e-4);
  }
  EXPECT_EQ(fences(square_surface(), sun({1, 1, 0})).size(), 2U);
}

TEST(Fences, StandAroundLampsInThePlane) {
  const auto near = [](double z, double radius) {
    return fences(square_surface(), LightBall{false, {3, 0, z}, radius}).size();
  };
  EXPECT_EQ(near(0, 0), 1U);
  EXPECT_EQ(near(-1e-4, 0), 1U);
  EXPECT_EQ(near(1, 0), 0U);
  EXPECT_EQ(near(-1, 0), 0U);
  EXPECT_GE(near(0.5, 0.6), 1U);
}

TEST(Fences, AreHighEnoughFarFromTheOrigin) {
  Mat44 far;
  far.setTranslation(Vec3d(0, 0, 5000));
  const auto found = make_fences(square_surface(far), {sun({1, 0, 0})}, Vec2(4, 4)).strips;
  ASSERT_EQ(found.size(), 1U);
  const double steps =
      256 * (std::nextafter(5000.0F, 1e9F) - 5000.0F);  // by which Cycles may move a ray's start
  EXPECT_GT(top(found[0]) - 5000, steps);
}

/// Cycles starts rays 1e-5 off a face, however small that is; 16 texels along the square.
TEST(Fences, DoNotStandWhereTheirOwnShadowWouldShow) {
  const auto made = [](double size) {
    return make_fences(square_surface(Mat44().setScale(size)), {sun({1, 0, 0})}, Vec2(16, 16));
  };
  EXPECT_EQ(made(2e-4).strips.size(), 1U);
  EXPECT_EQ(made(2e-4).left_out, 0);
  EXPECT_TRUE(made(5e-5).strips.empty());
  EXPECT_NEAR(made(5e-5).left_out, 1e-5 / (2 * 5e-5 / 16), 0.1);
}

TEST(Fences, BallsHoldTheirLights) {
  SceneSurvey survey;
  LightInfo area;
  area.type = "AREA";
  area.shape = "RECTANGLE";
  area.sizes = {{"size", 6}, {"size_y", 8}};
  area.to_world.setTranslation(Vec3d(1, 2, 3));
  LightInfo round = area;
  round.shape = "DISK";
  LightInfo sun;
  sun.type = "SUN";
  sun.sizes = {{"angle", pi / 3}};
  survey.lights = {area, round, sun};
  const auto balls = light_balls(survey);
  ASSERT_EQ(balls.size(), 3U);
  EXPECT_NEAR(balls[0].radius, 5, 1e-12);
  EXPECT_EQ(balls[0].place, Vec3d(1, 2, 3));
  EXPECT_GE(balls[1].radius, 3);
  EXPECT_TRUE(balls[2].far);
  EXPECT_NEAR(balls[2].radius, 0.5, 1e-12);
  EXPECT_EQ(balls[2].place, Vec3d(0, 0, 1));
}

}  // namespace
}  // namespace rnmbake
