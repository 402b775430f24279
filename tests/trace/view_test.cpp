#include "trace/view.h"

#include "trace/path.h"
#include "trace/trace_scenes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Three units above the origin, looking down; y of the world is up in the picture.
Camera from_above() {
  Camera camera;
  camera.name = "camera";
  camera.to_world.setTranslation(Vec3d(0, 0, 3));
  camera.angle_x = camera.angle_y = 2 * std::atan(0.5);  // 3 units wide on the ground
  camera.resolution_x = camera.resolution_y = 64;
  return camera;
}

ViewOptions picture(int width, int height, int samples = 4) {
  ViewOptions options;
  options.width = width;
  options.height = height;
  options.samples = samples;
  return options;
}

Vec3 on_ground(const Ray& ray) {
  return ray.origin - ray.direction * (ray.origin.z / ray.direction.z);
}

Vec3 nothing(const Vertex& /*vertex*/, Sampler& /*sampler*/) {
  return Vec3(0);
}

void expect_near(const Vec3& a, const Vec3& b) {
  EXPECT_LT((a - b).length(), 1e-5) << a << " is not " << b;
}

Vec3 colour(const FloatImage& image, int x, int y) {
  const auto texel = image.texel(x, y);
  return {texel[0], texel[1], texel[2]};
}

TEST(CameraRays, FillTheFieldOfView) {
  const CameraRays rays(from_above(), 60, 60);
  expect_near(on_ground(rays.through(30, 30)), Vec3(0, 0, 0));
  expect_near(on_ground(rays.through(0, 0)), Vec3(-1.5F, 1.5F, 0));
  expect_near(on_ground(rays.through(60, 60)), Vec3(1.5F, -1.5F, 0));
  EXPECT_NEAR(rays.through(13, 47).direction.length(), 1, 1e-6);
}

TEST(CameraRays, AnotherShapeOfPictureKeepsTheWidth) {
  const CameraRays rays(from_above(), 60, 30);
  expect_near(on_ground(rays.through(0, 0)), Vec3(-1.5F, 0.75F, 0));
}

TEST(CameraRays, PixelsKeepTheirShape) {
  Camera camera = from_above();
  camera.angle_y = 2 * std::atan(0.25);  // as many pixels, half as high
  EXPECT_NEAR(pixel_shape(camera), 2, 1e-12);
  expect_near(on_ground(CameraRays(camera, 30, 30).through(0, 0)), Vec3(-1.5F, 0.75F, 0));
}

TEST(CameraRays, ShiftsAreInWidthsOfThePicture) {
  Camera camera = from_above();
  camera.shift_x = 0.5;
  camera.shift_y = -0.25;
  expect_near(on_ground(CameraRays(camera, 60, 30).through(30, 15)), Vec3(1.5F, -0.75F, 0));
}

TEST(CameraRays, OrthographicOnesAreParallel) {
  Camera camera = from_above();
  camera.orthographic = true;
  camera.width = 4;
  camera.shift_x = 0.25;
  const CameraRays rays(camera, 40, 20);
  expect_near(rays.through(0, 0).origin, Vec3(-1, 1, 3));
  expect_near(rays.through(0, 0).direction, Vec3(0, 0, -1));
  expect_near(rays.through(40, 20).origin, Vec3(3, -1, 3));
}

TEST(CameraRays, FollowTheCamerasMatrix) {
  Camera camera = from_above();
  camera.to_world.setAxisAngle(Vec3d(1, 0, 0), pi / 2);  // looks along +y, z is up
  camera.to_world *= Mat44().setTranslation(Vec3d(0, -2, 1));
  const Ray ray = CameraRays(camera, 60, 60).through(30, 0);
  expect_near(ray.origin, Vec3(0, -2, 1));
  expect_near(ray.direction, Vec3(0, 2, 1).normalized());
}

// The ground is 1.5 units wide in a picture of 3: the middle half of each side, edges half-way into a pixel.
TEST(View, CountsTheShareOfSurfaceAndShowsTheWorldElsewhere) {
  DiffuseScene scene;
  add_object(scene, "ground", {level(0.75F, 0)}, Vec3(0.5F, 0.25F, 0), Vec3(2, 0, 0));
  scene.world.radiance = Vec3(0, 0, 7);
  const TraceScene traced(scene, "4.3.2");
  const View view = trace_view(traced, from_above(), picture(6, 6, 256), nothing);
  EXPECT_EQ(view.coverage.texel(2, 2)[0], 1);
  expect_near(colour(view.beauty, 2, 2), Vec3(2, 0, 0));
  expect_near(colour(view.albedo, 2, 2), Vec3(0.5F, 0.25F, 0));
  EXPECT_EQ(view.coverage.texel(0, 0)[0], 0);
  expect_near(colour(view.beauty, 0, 0), Vec3(0, 0, 7));
  // Of 256 places of a (0,2)-sequence one lies in each of as many strips of a pixel: rounding at the edge
  // takes one at most.
  EXPECT_NEAR(view.coverage.texel(1, 2)[0], 0.5, 1.0 / 256);
  expect_near(colour(view.albedo, 1, 2), Vec3(0.5F, 0.25F, 0) * view.coverage.texel(1, 2)[0]);
}

TEST(View, LooksThroughWhatCamerasDoNotSee) {
  DiffuseScene scene;
  add_object(scene, "ground", {level(4, 0)}, Vec3(0.5F));
  add_object(scene, "ghost", {level(4, 1)}, Vec3(1), Vec3(9));
  add_object(scene, "other ghost", {level(4, 1.5F, false)}, Vec3(1), Vec3(9));
  scene.survey.objects[0].visible_to_camera = true;
  scene.survey.objects[1].visible_to_camera = scene.survey.objects[2].visible_to_camera = false;
  const TraceScene traced(scene, "4.3.2");
  const View view = trace_view(traced, from_above(), picture(8, 8), nothing);
  for (const float value : view.beauty.data()) EXPECT_EQ(value, 0);
  for (const float value : view.albedo.data()) EXPECT_FLOAT_EQ(value, 0.5F);
}

TEST(View, IsTheSameAtAnyNumberOfThreadsAndOtherForAnotherSeed) {
  DiffuseScene scene;
  add_object(scene, "room", room(4), Vec3(0.5F), Vec3(1));
  const TraceScene traced(scene, "4.3.2");
  const ReflectedLight lit = [&](const Vertex& vertex, Sampler& sampler) {
    std::int64_t rays = 0;
    return reflected_radiance(traced, vertex, {}, sampler, rays);
  };
  ViewOptions options = picture(16, 9);
  options.threads = 1;
  const View one = trace_view(traced, from_above(), options, lit);
  options.threads = 3;
  EXPECT_EQ(trace_view(traced, from_above(), options, lit).beauty.data(), one.beauty.data());
  options.seed = 1;
  EXPECT_NE(trace_view(traced, from_above(), options, lit).beauty.data(), one.beauty.data());
}

TEST(View, SaysHowFarItIsAndStops) {
  DiffuseScene scene;
  add_object(scene, "ground", {level(1, 0)}, Vec3(0.5F));
  const TraceScene traced(scene, "4.3.2");
  double last = 0;
  (void)trace_view(traced, from_above(), picture(4, 4), nothing, [&](double share) {
    EXPECT_GT(share, last);
    last = share;
  });
  EXPECT_EQ(last, 1);
  const View stopped = trace_view(traced, from_above(), picture(4, 4), nothing, {}, [] { return true; });
  for (const float value : stopped.coverage.data()) EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace rnmbake
