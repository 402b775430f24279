#include "trace/lights/lamp.h"

#include "trace/lights/light_support.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

const Vec3 up(0, 0, 1);
const Vec3 tilted = Vec3(0.8F, -0.3F, 0.5F).normalized();

TEST(LightLampTest, PointLampIsItsClosedForm) {
  LitScene scene;
  scene.lamp("POINT", 40).to_world.translate(Vec3d(0.3, -0.4, 2));
  const Vec3 way(0.3F, -0.4F, 2);
  const double expected = 40 / (4 * pi) / way.length2();
  for (const Vec3& normal : {up, tilted}) {
    expect_irradiance(scene.lights(), {0, 0, 0}, normal, expected * way.normalized().dot(normal), "point");
  }
}

TEST(LightLampTest, SoftPointLampIsADiskThatTurns) {
  LitScene scene;
  scene.lamp("POINT", 40, {{"shadow_soft_size", 0.8}, {"use_soft_falloff", 1}})
      .to_world.translate(Vec3d(0, 0, 1));
  const Lights lights = scene.lights();
  expect_irradiance(lights, {0, 0, 0}, up, 40 / (4 * pi) / (1 + 0.64), "facing");
  const double radiance = 40 / (4 * pi * pi * 0.64), edge = 1 / std::sqrt(1.64);
  const Vec3 steep = Vec3(1, 0, 0.4F).normalized();  // part of the disk is below its horizon
  const double truth = over_sphere(
                           up, [&](const Vec3& d) { return std::max(0.0F, d.dot(steep)); }, 1500, edge) *
                       radiance;
  expect_irradiance(lights, {0, 0, 0}, steep, truth, "steep");
}

TEST(LightLampTest, HardPointLampIsASphere) {
  LitScene scene;
  scene.lamp("POINT", 40, {{"shadow_soft_size", 0.8}, {"use_soft_falloff", 0}})
      .to_world.translate(Vec3d(0, 0, 1));
  const Lights lights = scene.lights();
  expect_irradiance(lights, {0, 0, 0}, up, 40 / (4 * pi), "outside, as if from the middle");
  expect_irradiance(lights, {0.1F, 0, 1.2F}, up, 40 / (4 * pi * 0.64), "inside, even from all sides");
}

TEST(LightLampTest, SunsOfAnySize) {
  for (const char* version : {"3.4.1", "4.3.2"}) {
    LitScene scene;
    scene.lamp("SUN", 3, {{"angle", 1.2}}).to_world.rotate(Vec3d(0.5, 0, 0));
    const Vec3 axis(row(scene.diffuse_scene.survey.lights[0].to_world, 2));
    const double c = std::cos(0.6);
    const bool flat = version[0] == '3';
    // A flat disk at distance 1 has the density slant^3 per solid angle; later suns are even per solid angle.
    const double scale =
        flat ? 3 / (pi * std::tan(0.6) * std::tan(0.6)) : 3 / (pi * std::sin(0.6) * std::sin(0.6));
    for (const Vec3& normal : {axis, up, Vec3(axis.y, -axis.z, axis.y).normalized()}) {
      const double truth = scale * over_sphere(
                                       axis,
                                       [&](const Vec3& d) {
                                         const double z = d.dot(axis);
                                         return std::max(0.0F, d.dot(normal)) * (flat ? 1 / (z * z * z) : 1);
                                       },
                                       1500, c);
      expect_irradiance(scene.lights(version), {0, 0, 0}, normal, truth, version);
    }
    expect_irradiance(scene.lights(version), {0, 0, 0}, axis, flat ? 3 * 2 * c / (1 + c) : 3, "facing");
  }
}

struct AreaCase {
  LitScene scene;
  std::vector<Vec3d> corners;
  double radiance = 0;
};

AreaCase square_above(double half, double height) {
  AreaCase area;
  LightInfo& lamp = area.scene.lamp("AREA", 10, {{"size", 2 * half}});
  lamp.shape = "SQUARE";
  lamp.to_world.translate(Vec3d(0, 0, height));
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    area.corners.emplace_back(x * half, y * half, height);
  }
  area.radiance = 10 / (pi * 4 * half * half);
  return area;
}

TEST(LightLampTest, SquareLampsNearAndFar) {
  for (const double height : {0.05, 0.5, 1.0, 40.0}) {
    const AreaCase area = square_above(1, height);
    const Lights lights = area.scene.lights();
    for (const Vec3& normal : {up, tilted}) {
      for (const Vec3& point : {Vec3(0, 0, 0), Vec3(0.7F, 0.2F, 0), Vec3(3, -1, 0)}) {
        const double truth = area.radiance * polygon_irradiance(area.corners, Vec3d(point), Vec3d(normal));
        if (truth > 0) expect_irradiance(lights, point, normal, truth, "height " + std::to_string(height));
      }
    }
  }
  const AreaCase area = square_above(1, 1);  // facts known to ten digits elsewhere
  EXPECT_NEAR(polygon_irradiance(area.corners, {0, 0, 0}, {0, 0, 1}), 1.74083950, 1e-8);
}

TEST(LightLampTest, AreasShineOneWay) {
  const AreaCase area = square_above(1, 1);
  EXPECT_EQ(irradiance(area.scene.lights(), {0, 0, 2}, {0, 0, -1}).mean, 0);
  EXPECT_EQ(irradiance(area.scene.lights(), {0.2F, 0.3F, 1}, {0, 0, -1}).mean, 0) << "a point on the lamp";
}

TEST(LightLampTest, AreasOfEveryShapeAndSpread) {
  for (const char* shape : {"RECTANGLE", "ELLIPSE", "DISK"}) {
    for (const double spread : {pi, 1.7, 0.5}) {
      LitScene scene;
      LightInfo& lamp = scene.lamp("AREA", 10, {{"size", 1.6}, {"size_y", 0.7}, {"spread", spread}});
      lamp.shape = shape;
      lamp.to_world.translate(Vec3d(0.2, 0.1, 1));
      lamp.to_world.rotate(Vec3d(0.3, 0.2, 0.4));
      lamp.to_world.scale(Vec3d(1.3, 0.8, 2));
      const Mat44& m = lamp.to_world;
      const Vec3d u = row(m, 0) * 0.8, v = row(m, 1) * (lamp.shape == "DISK" ? 0.8 : 0.35);
      const Vec3d axis = -row(m, 2).normalized(), centre = row(m, 3);
      const bool round = lamp.shape != "RECTANGLE";
      const double a = spread / 2, scale = spread == pi ? 1 : 1 / (1 - a / std::tan(a));
      const Vec3 point(0.3F, -0.1F, 0), normal = Vec3(0.2F, 0.1F, 1).normalized();
      constexpr int steps = 2000;
      double sum = 0;
      for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
          double x = 2 * (i + 0.5) / steps - 1, y = 2 * (j + 0.5) / steps - 1;
          if (round) {
            const double r = std::sqrt((i + 0.5) / steps), angle = 2 * pi * (j + 0.5) / steps;
            x = r * std::cos(angle);
            y = r * std::sin(angle);
          }
          const Vec3d way = centre + u * x + v * y - Vec3d(point);
          const double d2 = way.length2(), c = -way.dot(axis) / std::sqrt(d2), n = way.dot(Vec3d(normal));
          if (c <= 0 || n <= 0) continue;
          const double tangent = std::sqrt(1 - c * c) / c;
          const double share = spread == pi ? 1 : std::max(0.0, 1 - tangent / std::tan(a)) * scale;
          sum += share * c * n / (d2 * std::sqrt(d2));
        }
      }
      const double truth = sum / (double(steps) * steps) * 10 / pi;  // radiance x area = P / pi
      expect_irradiance(scene.lights(), point, normal, truth,
                        std::string(shape) + " " + std::to_string(spread));
    }
  }
}

}  // namespace
}  // namespace rnmbake
