#include "trace/lights/world_light.h"

#include "trace/lights/light_support.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

LitScene pictured(int width, int height, const std::function<float(int x, int y)>& value) {
  LitScene scene;
  Texture picture{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) picture.texels.emplace_back(value(x, y));
  }
  scene.diffuse_scene.pictures.push_back(picture);
  scene.diffuse_scene.world.picture = 0;
  return scene;
}

TEST(WorldLightTest, ConstantSkiesLightEverySideAlike) {
  LitScene scene;
  scene.diffuse_scene.world.radiance = Vec3(0.7F);
  for (const Vec3& normal : {up, tilted, -up}) {
    expect_irradiance(scene.lights(), {0, 0, 0}, normal, 0.7 * pi, "told the normal");
    expect_irradiance(scene.lights(), {0, 0, 0}, normal, 0.7 * pi, "not told", false);
  }
  const WorldLight world(scene.diffuse_scene);
  EXPECT_EQ(world.pdf(up, -up), 0);
  EXPECT_NEAR(over_sphere(up, [&](const Vec3& d) { return world.pdf(tilted, d); }), 1, 1e-3);
  EXPECT_NEAR(over_sphere(up, [&](const Vec3& d) { return world.pdf(nowhere, d); }), 1, 1e-5);
}

/// The density is even in each cell: cells times their solid angles are its integral.
double sum_of_cells(const WorldLight& world, const Texture& picture) {
  double sum = 0;
  const double w = picture.width, h = picture.height;
  for (int y = 0; y < picture.height; ++y) {
    const double solid_angle = (std::cos(pi * y / h) - std::cos(pi * (y + 1) / h)) * 2 * pi / w;
    for (int x = 0; x < picture.width; ++x) {
      const Vec2 uv(static_cast<float>((x + 0.5) / w), static_cast<float>(1 - (y + 0.5) / h));
      sum += world.pdf(up, world_direction(uv)) * solid_angle;
    }
  }
  return sum;
}

/// The picture's own values, summed over the sphere, against samples of it.
TEST(WorldLightTest, PicturesOfManyKinds) {
  const auto sky = [](int x, int y) { return 0.2F + static_cast<float>((x * 7 + y * 13) % 10); };
  const auto sun = [](int x, int y) { return x == 5 && y == 2 ? 500.0F : 0.01F; };
  const auto pole = [](int, int y) { return y == 0 ? 30.0F : 0.0F; };
  for (const LitScene& scene : {pictured(32, 16, sky), pictured(16, 8, sun), pictured(16, 9, pole),
                                pictured(1, 1, sky), pictured(2, 1, sky)}) {
    const Lights lights = scene.lights();
    for (const Vec3& normal : {up, tilted}) {
      const double truth = over_sphere(
          up, [&](const Vec3& d) { return lights.world(d).x * std::max(0.0F, d.dot(normal)); }, 600);
      const Estimate seen = irradiance(lights, {0, 0, 0}, normal, true, 100);
      EXPECT_LE(seen.error, 1e-3 * truth);
      EXPECT_NEAR(seen.mean, truth, 4 * seen.error + 1e-4 * truth);  // the sum's own error
    }
    EXPECT_NEAR(sum_of_cells(WorldLight(scene.diffuse_scene), scene.diffuse_scene.pictures[0]), 1, 1e-5);
  }
}

TEST(WorldLightTest, DensitiesAreThoseOfTheSamples) {
  const LitScene scene = pictured(300, 150, [](int x, int y) { return static_cast<float>((x ^ y) % 17); });
  const WorldLight world(scene.diffuse_scene);
  std::mt19937 random(1);
  const auto next = [&] { return static_cast<float>(random() >> 8) * 0x1p-24F; };
  int differ = 0;
  for (int i = 0; i < 100000; ++i) {
    const LightSample sample = world.sample(up, {next(), next()}, next());
    EXPECT_TRUE(sample.bsdf_can_hit);
    EXPECT_TRUE(std::isinf(sample.distance));
    EXPECT_NEAR((sample.radiance - world.radiance(sample.direction)).length(), 0, 0.01);
    differ += std::abs(world.pdf(up, sample.direction) - sample.pdf) > 1e-4F * sample.pdf;
  }
  EXPECT_LE(differ, 100) << "only directions at the edge of a cell may be taken for its neighbour's";
}

/// Bilinear reading spreads a texel over its neighbours, across the seam as well.
TEST(WorldLightTest, NothingThatShinesIsMissed) {
  const LitScene scene = pictured(8, 4, [](int x, int y) { return x == 0 && y == 2 ? 1.0F : 0.0F; });
  const WorldLight world(scene.diffuse_scene);
  over_sphere(
      up,
      [&](const Vec3& d) {
        if (world.radiance(d).x > 0) {
          EXPECT_GT(world.pdf(up, d), 0);
        }
        return 0.0;
      },
      200);
}

TEST(WorldLightTest, BlackWorldsGiveNothing) {
  EXPECT_TRUE(WorldLight(DiffuseScene{}).black());
  EXPECT_TRUE(pictured(4, 2, [](int, int) { return 0.0F; }).lights().empty());
}

}  // namespace
}  // namespace rnmbake
