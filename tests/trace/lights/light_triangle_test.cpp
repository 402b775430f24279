#include "trace/lights/light_triangle.h"

#include "trace/lights/light_support.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(LightTriangleTest, GlowingTrianglesShineBothWays) {
  LitScene scene;
  const Vec3 a(-0.5F, -0.6F, 1), b(1.5F, 0, 0.8F), c(0, 1, 1.4F);
  scene.triangle(scene.material({2, 1, 0.5F}), a, b, c);
  const Lights lights = scene.lights();
  for (const Vec3& point : {Vec3(0, 0, 0), Vec3(0.2F, 0.1F, 0.95F), Vec3(5, 3, -8), Vec3(0.1F, 0.4F, 3)}) {
    const Vec3 to_it = ((a + b + c) / 3 - point).normalized();
    for (const Vec3& normal : {to_it, (to_it + Vec3(0.9F, 0.2F, 0)).normalized()}) {
      const double truth =
          2 * polygon_irradiance({Vec3d(a), Vec3d(b), Vec3d(c)}, Vec3d(point), Vec3d(normal));
      expect_irradiance(lights, point, normal, truth, "triangle");
    }
  }
}

TEST(LightTriangleTest, PicturedTrianglesAreReadWhereTheyAreHit) {
  LitScene scene;
  Texture picture{64, 64, std::vector<Vec3>(64 * 64, Vec3(0, 0, 0))};
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) picture.texels[std::size_t(64) * y + x] = Vec3(static_cast<float>(x) / 32);
  }
  scene.diffuse_scene.pictures.push_back(picture);
  scene.triangle(scene.material({0, 0, 0}, 0), {-1, -1, 2}, {1, -1, 2}, {-1, 1, 2});
  double truth = 0;
  constexpr int steps = 1500;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const double root = std::sqrt((i + 0.5) / steps), b2 = root * (j + 0.5) / steps, b1 = root - b2;
      const double texel = std::clamp(b1 * 64 - 0.5, 0.0, 63.0) / 32,
                   d2 = std::pow(2 * b1 - 1, 2) + std::pow(2 * b2 - 1, 2) + 4;
      truth += texel * 2 * 4 / (d2 * d2) / (double(steps) * steps);
    }
  }
  expect_irradiance(scene.lights(), {0, 0, 0}, up, truth, "pictured");
}

TEST(LightTriangleTest, OneLitTexelIsEnough) {
  LitScene scene;
  Texture picture{256, 256, std::vector<Vec3>(256 * 256, Vec3(0, 0, 0))};
  picture.texels[256 * 130 + 77] = Vec3(1000, 0, 0);
  scene.diffuse_scene.pictures.push_back(picture);
  scene.triangle(scene.material({0, 0, 0}, 0), {-1, -1, 2}, {1, -1, 2}, {-1, 1, 2});
  EXPECT_GT(irradiance(scene.lights(), {0, 0, 0}, up).mean, 0);
  EXPECT_GT(scene.lights().triangle_pdf({0, 0, 0}, up, 0, up, 2), 0);
}

}  // namespace
}  // namespace rnmbake
