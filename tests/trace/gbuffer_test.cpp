#include "trace/gbuffer.h"

#include "trace/trace_scenes.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

constexpr int side = 8;
constexpr double high = 3;  // of the camera over the ground

/// Looks down on a square of 4 units of the ground; y of the world is up in the picture.
Camera from_above(const Vec3d& middle = Vec3d(0)) {
  Camera camera;
  camera.to_world.setTranslation(middle + Vec3d(0, 0, high));
  camera.angle_x = camera.angle_y = 2 * std::atan(2 / high);
  camera.resolution_x = camera.resolution_y = side;
  return camera;
}

GBuffer of(const DiffuseScene& scene, const Camera& camera) {
  const TraceScene traced(scene, "4.3.2");
  ViewOptions options;
  options.width = options.height = side;
  return trace_gbuffer(traced, camera, options, [](const Vertex& vertex) { return vertex.normal; });
}

Vec3 at(const FloatImage& image, int x, int y) {
  const auto texel = image.texel(x, y);
  return {texel[0], texel[1], texel[2]};
}

/// Where the ray through a pixel's centre meets the plane z = height.
Vec3 place(int x, int y, float height) {
  const float share = (static_cast<float>(high) - height) / static_cast<float>(high);
  const auto along = [](int i) { return 4 * (static_cast<float>(i) + 0.5F) / side - 2; };
  return {along(x) * share, -along(y) * share, height};
}

TEST(GBuffer, OfAPlaneFromAboveIsExact) {
  DiffuseScene scene;
  add_object(scene, "floor", {level(5, 0)}, Vec3(0.5F));
  const GBuffer buffer = of(scene, from_above());
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      EXPECT_LT((at(buffer.position, x, y) - place(x, y, 0)).length(), 2e-6F) << x << ", " << y;
      EXPECT_NEAR(buffer.depth.texel(x, y)[0], high, 1e-6);
      EXPECT_EQ(at(buffer.face, x, y), Vec3(0, 0, 1));
      EXPECT_LT((at(buffer.normal, x, y) - Vec3(0, 0, 1)).length(), 1e-6F);
      EXPECT_EQ(buffer.object.texel(x, y)[0], 1);
      EXPECT_EQ(buffer.coverage.texel(x, y)[0], 1);
    }
  }
}

TEST(GBuffer, APixelHoldsOneSurfaceAndNoMean) {
  DiffuseScene scene;
  add_object(scene, "floor", {level(5, 0)}, Vec3(0.5F));
  add_object(scene, "table", {level(0.6F, 1)}, Vec3(0.5F));
  const GBuffer buffer = of(scene, from_above());
  int tables = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const Vec3 on_table = place(x, y, 1);
      const bool table = std::max(std::abs(on_table.x), std::abs(on_table.y)) < 0.6F;
      tables += table ? 1 : 0;
      EXPECT_EQ(buffer.object.texel(x, y)[0], table ? 2 : 1) << x << ", " << y;
      EXPECT_NEAR(buffer.depth.texel(x, y)[0], table ? high - 1 : high, 1e-6);
    }
  }
  EXPECT_EQ(tables, 16);  // centres at 1/6 and 3/6 on each side, seen from two units away
}

TEST(GBuffer, IsZeroWhereNothingIsAndPassesWhatCamerasDoNotSee) {
  DiffuseScene scene;
  add_object(scene, "floor", {level(1, 0)}, Vec3(0.5F));
  add_object(scene, "hidden", {level(1, 1)}, Vec3(0.5F));
  scene.survey.objects[1].visible_to_camera = false;
  const GBuffer buffer = of(scene, from_above());
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const Vec3 on_floor = place(x, y, 0);
      const bool covered = std::max(std::abs(on_floor.x), std::abs(on_floor.y)) < 1;
      EXPECT_EQ(buffer.coverage.texel(x, y)[0], covered ? 1 : 0) << x << ", " << y;
      EXPECT_EQ(buffer.object.texel(x, y)[0], covered ? 1 : 0);
      if (covered) continue;
      EXPECT_EQ(buffer.depth.texel(x, y)[0], 0);
      for (const FloatImage* image : {&buffer.normal, &buffer.face, &buffer.position})
        EXPECT_EQ(at(*image, x, y), Vec3(0));
    }
  }
}

TEST(GBuffer, FacesAreOnTheSideThatIsSeen) {
  DiffuseScene scene;
  add_object(scene, "ceiling", {level(5, 0, false)}, Vec3(0.5F));
  const GBuffer buffer = of(scene, from_above());
  EXPECT_EQ(at(buffer.face, 3, 3), Vec3(0, 0, 1));
}

/// Far from the origin positions are the world's, and the depth has not lost its digits.
TEST(GBuffer, OfASceneFarFromTheOrigin) {
  const Vec3 far(4096, -8192, 0);
  DiffuseScene scene;
  add_object(scene, "floor", {level(5, 0, true, far)}, Vec3(0.5F));
  const GBuffer buffer = of(scene, from_above(Vec3d(far)));
  EXPECT_LT((at(buffer.position, 2, 5) - far - place(2, 5, 0)).length(), 2e-3F);
  EXPECT_NEAR(buffer.depth.texel(2, 5)[0], high, 1e-6);
}

}  // namespace
}  // namespace rnmbake
