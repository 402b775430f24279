// Where a scene stands and how large it is does not show; light along a face does not reach it.
#include "trace/trace_scenes.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

Mat44 placed(double scale, const Vec3d& place) {
  Mat44 matrix;
  matrix.setScale(Imath::V3d(scale, scale, scale));
  for (int a = 0; a < 3; ++a) matrix[3][a] = place[a];
  return matrix;
}

/// A floor with a post on it, a slanted sun, a lamp and a glowing square.
DiffuseScene courtyard(double scale, const Vec3d& shift) {
  DiffuseScene scene;
  add_object(scene, "floor", {level(1, 0)}, Vec3(0.5F));
  add_object(scene, "post", room(0.25F, Vec3(0, 0, 0.25F)), Vec3(0.5F));
  add_object(scene, "glow", {level(0.25F, 1, false, Vec3(0.5F, 0.5F, 0))}, Vec3(0), Vec3(2));
  LightInfo sun = light("SUN", 3, {{"angle", 0}});
  sun.to_world.setAxisAngle(Imath::V3d(0, 1, 0), 0.8);
  LightInfo lamp = light("POINT", 20 * scale * scale, {{"shadow_soft_size", 0.1 * scale}});
  lamp.to_world = placed(scale, Vec3d(-0.5, 0.75, 1) * scale + shift);
  scene.survey.lights = {sun, lamp};
  for (SceneObject& object : scene.survey.objects) object.to_world = placed(scale, shift);
  return scene;
}

double largest_difference(const Gathered& a, const Gathered& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.directions.size(); ++k) {
    const auto &one = a.directions[k].radiance.data(), &other = b.directions[k].radiance.data();
    EXPECT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) most = std::max(most, std::abs(double(one[i]) - other[i]));
  }
  return most;
}

TEST(Places, FarFromTheOriginTheTruthIsTheSame) {
  const GatherOptions options = all_directions(16);
  const Gathered here = gather_one(courtyard(1, Vec3d(0)), 0, options, 16, 16);
  for (const double far : {1024.0, 5000.0, 1e5, 1e7}) {
    const Gathered there = gather_one(courtyard(1, Vec3d(far, -0.7 * far, 0.3 * far)), 0, options, 16, 16);
    EXPECT_LT(largest_difference(here, there), 1e-4) << far;
  }
}

TEST(Places, TheTruthIsTheSameAtAnySize) {
  const GatherOptions options = all_directions(16);
  const Gathered here = gather_one(courtyard(1, Vec3d(0)), 0, options, 16, 16);
  for (const double scale : {0x1p-14, 0x1p14}) {  // floats scale by them without rounding
    const Gathered there = gather_one(courtyard(scale, Vec3d(0)), 0, options, 16, 16);
    EXPECT_LT(largest_difference(here, there), 1e-4) << scale;
  }
}

TEST(Places, LightAlongAFaceDoesNotReachIt) {
  for (const double rise : {0.0, 1e-7, -1e-7, -1e-3, 1e-5, 1e-3}) {
    DiffuseScene scene;
    add_object(scene, "floor", {level(1, 0)}, Vec3(0));
    LightInfo sun = light("SUN", pi, {{"angle", 0}});  // from +x
    sun.to_world = Mat44(0, 0, 1, 0, 0, 1, 0, 0, std::cos(rise), 0, std::sin(rise), 0, 0, 0, 0, 1);
    scene.survey.lights = {sun};
    const Gathered gathered = gather_one(scene, 0, all_directions(4), 4, 4);
    const double expected =
        rise > 1e-6 ? std::sqrt(2.0 / 3) * std::cos(rise) + std::sin(rise) / std::sqrt(3.0) : 0;
    for (const float value : gathered.directions[1].radiance.data())
      EXPECT_NEAR(value, expected, 1e-5) << rise;
  }
}

}  // namespace
}  // namespace rnmbake
