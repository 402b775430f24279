#include "trace/lights/lights.h"

#include "trace/lights/light_support.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

TEST(LightsTest, NothingThatGlowsIsEmpty) {
  LitScene scene;
  scene.triangle(scene.material({0, 0, 0}), {0, 0, 1}, {1, 0, 1}, {0, 1, 1});
  scene.lamp("POINT", 0);
  const Lights lights = scene.lights();
  EXPECT_TRUE(lights.empty());
  EXPECT_EQ(lights.sample({0, 0, 0}, up, {0.5F, 0.5F, 0.5F}).pdf, 0);
  EXPECT_EQ(lights.world(up), Vec3(0, 0, 0));
  EXPECT_EQ(lights.world_pdf({0, 0, 0}, up, up), 0);
  EXPECT_EQ(lights.triangle_pdf({0, 0, 0}, up, 0, up, 1), 0);
}

/// A disk that faces the point: a cone of directions of even radiance.
/// An area lamp above the origin, shining down, with its corners.
/// Ellipses, narrowed spreads, turned and stretched lamps against a sum over their area.
/// Sharing light with a picture: half of the texels are dark.
/// Suns, lamps, triangles and the world at once: their sum, whatever is chosen how often.
LitScene everything() {
  LitScene scene;
  scene.diffuse_scene.world.radiance = Vec3(0.2F, 0.1F, 0.1F);
  scene.lamp("SUN", 0.5).to_world.rotate(Vec3d(0.4, 0.3, 0));
  scene.lamp("SUN", 0.1).to_world.rotate(Vec3d(2.4, 0.3, 0));  // from below
  scene.lamp("SUN", 0.3).to_world.rotate(Vec3d(-0.9, 0.3, 0));
  for (int i = 0; i < 12; ++i)
    scene.lamp("POINT", 3 + i).to_world.translate(Vec3d(i - 6, 0.3 * i, 1 + 0.2 * i));
  const int material = scene.material({1, 1, 1});
  for (int i = 0; i < 40; ++i) {
    const int line = i / 8;
    const auto x = static_cast<float>(i % 8 - 4), y = static_cast<float>(line - 2);
    scene.triangle(material, {x, y, 3}, {x + 0.5F, y, 3}, {x, y + 0.5F, 3.5F});
  }
  return scene;
}

double truth_of_everything(const LitScene& scene, const Vec3d& point, const Vec3d& normal) {
  double sum = pi * double(scene.diffuse_scene.world.radiance.x);
  for (const LightInfo& light : scene.diffuse_scene.survey.lights) {
    const Vec3d axis = row(light.to_world, 2), way = row(light.to_world, 3) - point;
    if (light.type == "SUN")
      sum += light.energy * std::max(0.0, axis.dot(normal));
    else
      sum += light.energy / (4 * pi) / way.length2() * std::max(0.0, way.normalized().dot(normal));
  }
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const Vec3* p = &scene.triangles.position[3 * t];
    sum += polygon_irradiance({Vec3d(p[0]), Vec3d(p[1]), Vec3d(p[2])}, point, normal);
  }
  return sum;
}

TEST(LightsTest, EverythingAddsUp) {
  const LitScene scene = everything();
  const Lights lights = scene.lights();
  for (const Vec3& normal : {up, tilted}) {
    for (const Vec3& point : {Vec3(0, 0, 0), Vec3(2, 1, 0.5F), Vec3(0, 0, 30)}) {
      const double truth = truth_of_everything(scene, Vec3d(point), Vec3d(normal));
      const Estimate seen = irradiance(lights, point, normal, true, 300);
      EXPECT_LE(seen.error, 1e-3 * truth);
      EXPECT_NEAR(seen.mean, truth, 4 * seen.error);
    }
  }
}

/// What a ray may meet by chance has the same density both ways.
TEST(LightsTest, DensitiesAgree) {
  const LitScene scene = everything();
  const Lights lights = scene.lights();
  std::mt19937 random(5);
  const auto next = [&] { return static_cast<float>(random() >> 8) * 0x1p-24F; };
  int worlds = 0, triangles = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 point(4 * next() - 2, 4 * next() - 2, 2 * next());
    const Vec3 normal = i % 3 == 0 ? Vec3(0, 0, 0) : i % 3 == 1 ? up : tilted;
    const LightSample sample = lights.sample(point, normal, {next(), next(), next()});
    if (sample.pdf == 0 || !sample.bsdf_can_hit) continue;
    if (std::isinf(sample.distance)) {
      ++worlds;
      EXPECT_NEAR(lights.world_pdf(point, normal, sample.direction), sample.pdf, 1e-4 * sample.pdf);
      continue;
    }
    ++triangles;
    const Vec3 place = point + sample.direction * sample.distance;
    std::uint32_t nearest = 0;
    float least = std::numeric_limits<float>::infinity();
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
      const Vec3* p = &scene.triangles.position[3 * t];
      const Vec3d n = Vec3d(p[1] - p[0]).cross(Vec3d(p[2] - p[0])), q(place - p[0]);
      const double b1 = Vec3d(q).cross(Vec3d(p[2] - p[0])).dot(n) / n.length2();
      const double b2 = Vec3d(p[1] - p[0]).cross(q).dot(n) / n.length2();
      const auto off = static_cast<float>(std::max({-b1, -b2, b1 + b2 - 1, std::abs(q.dot(n)) / n.length()}));
      if (off < least) {
        least = off;
        nearest = t;
      }
    }
    EXPECT_NEAR(lights.triangle_pdf(point, normal, nearest, sample.direction, sample.distance), sample.pdf,
                2e-4 * sample.pdf);
  }
  EXPECT_GT(worlds, 1000);
  EXPECT_GT(triangles, 1000);
}

/// The densities of all that can be met by chance sum to the probability of choosing such a light.
TEST(LightsTest, DensitiesIntegrateToTheShareOfChanceHits) {
  LitScene scene = everything();
  scene.triangles = {};
  const int material = scene.material({5, 5, 5});
  const Vec3 a(-1, -1, 1), b(1, -1, 1), c(0, 1, 1.2F);
  scene.triangle(material, a, b, c);
  const Lights lights = scene.lights();
  const Vec3 point(0.1F, 0, 0);
  const Vec3 n = (b - a).cross(c - a).normalized();
  const double sum = over_sphere(up, [&](const Vec3& d) {
    double density = lights.world_pdf(point, up, d);
    const float distance = (a - point).dot(n) / d.dot(n);
    const Vec3 q = point + d * distance - a;
    const float b1 = q.cross(c - a).dot(n), b2 = (b - a).cross(q).dot(n),
                whole = (b - a).cross(c - a).length();
    if (distance > 0 && b1 >= 0 && b2 >= 0 && b1 + b2 <= whole) {
      density += lights.triangle_pdf(point, up, 0, d, distance);
    }
    return density;
  });
  int chance = 0;
  constexpr int samples = 400000;
  std::mt19937 random(7);
  for (int i = 0; i < samples; ++i) {
    const auto next = [&] { return static_cast<float>(random() >> 8) * 0x1p-24F; };
    const LightSample sample = lights.sample(point, up, {next(), next(), next()});
    chance += sample.pdf > 0 && sample.bsdf_can_hit;
  }
  const double share = double(chance) / samples;
  EXPECT_NEAR(sum, share, 4 * std::sqrt(share * (1 - share) / samples) + 1e-3);
}

TEST(LightsTest, PointsOnALightAndOddTrianglesGiveFiniteNumbers) {
  LitScene scene;
  const int material = scene.material({1, 1, 1});
  scene.triangle(material, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  scene.triangle(material, {0, 0, 1}, {1, 0, 1}, {2, 0, 1});          // a line
  scene.triangle(material, {0, 0, 1}, {1e-7F, 0, 1}, {0, 1e-7F, 1});  // tiny
  scene.triangle(material, {5, 5, 1}, {5, 5, 1}, {5, 5, 1});          // a point
  scene.triangle(material, {0, 0, 2}, {100, 1e-6F, 2}, {200, 0, 2});  // a needle
  scene.lamp("POINT", 10, {{"shadow_soft_size", 0.2}});
  scene.lamp("AREA", 10, {{"size", 0.0}});
  scene.lamp("SPOT", 10, {{"spot_size", 3.14159}, {"spot_blend", 1.0}});
  const Lights lights = scene.lights();
  std::mt19937 random(3);
  const auto next = [&] { return static_cast<float>(random() >> 8) * 0x1p-24F; };
  for (const Vec3& point :
       {Vec3(0, 0, 0), Vec3(0.2F, 0.2F, 0), Vec3(1, 0, 0), Vec3(0.25F, 0.25F, 1e-6F), Vec3(0, 0, 1)}) {
    for (int i = 0; i < 2000; ++i) {
      const LightSample s = lights.sample(point, i % 2 == 0 ? up : Vec3(0, 0, 0), {next(), next(), next()});
      EXPECT_TRUE(std::isfinite(s.pdf) && s.pdf >= 0);
      EXPECT_TRUE(std::isfinite(s.radiance.x) && std::isfinite(s.distance));
      EXPECT_NEAR(s.direction.length(), 1, 1e-5);
    }
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
      EXPECT_TRUE(std::isfinite(lights.triangle_pdf(point, up, t, Vec3(0, 0.6F, 0.8F), 1)));
    }
  }
}

/// A kilometre from the origin the same lamps give the same light.
TEST(LightsTest, FarFromTheOrigin) {
  LitScene scene;
  const Vec3 far(1024, -512, 256);  // exact in floats
  scene.triangle(scene.material({2, 2, 2}), far + Vec3(-1, -1, 1), far + Vec3(1, -1, 1), far + Vec3(0, 1, 1));
  const double truth = 2 * polygon_irradiance({{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}}, {0, 0, 0}, {0, 0, 1});
  expect_irradiance(scene.lights(), far, up, truth, "triangle");
  LitScene area;
  LightInfo& lamp = area.lamp("AREA", 10, {{"size", 2}});
  lamp.shape = "SQUARE";
  lamp.to_world.translate(Vec3d(far) + Vec3d(0, 0, 1));
  expect_irradiance(area.lights(), far, up, 10 / (4 * pi) * 1.74083950, "square");
}

/// Ten thousand small lamps over a floor: the tree against choosing evenly.
TEST(LightsTest, ManyLightsAreChosenWell) {
  LitScene scene;
  std::mt19937 random(11);
  const auto next = [&] { return double(random() >> 8) * 0x1p-24; };
  const int material = scene.material({1, 1, 1});
  for (int i = 0; i < 5000; ++i) {
    scene.lamp("POINT", 1).to_world.translate(Vec3d(100 * next(), 100 * next(), 2 + next()));
    const Vec3 at(Vec3d(100 * next(), 100 * next(), 2 + next()));
    scene.triangle(material, at, at + Vec3(0.2F, 0, 0.1F), at + Vec3(0, 0.2F, 0));
  }
  const Lights lights = scene.lights();
  const Vec3 point(50, 40, 0);
  double truth = truth_of_everything(scene, Vec3d(point), {0, 0, 1}), even_square = 0;
  for (const LightInfo& light : scene.diffuse_scene.survey.lights) {
    const Vec3d way = row(light.to_world, 3) - Vec3d(point);
    even_square += 10000 * std::pow(1 / (4 * pi) / way.length2() * way.normalized().z, 2);
  }
  double sum = 0, squares = 0;
  constexpr int samples = 1000000;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < samples; ++i) {
    const LightSample s = lights.sample(point, up, Vec3(Vec3d(next(), next(), next())));
    const double value = s.pdf > 0 ? double(s.radiance.x) * std::max(0.0F, s.direction.z) / s.pdf : 0;
    sum += value;
    squares += value * value;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const double mean = sum / samples, variance = squares / samples - mean * mean;
  EXPECT_NEAR(mean, truth, 4 * std::sqrt(variance / samples));
  const double even_variance = even_square - truth * truth;  // of the lamps alone: less than all
  std::printf("10,000 lights: relative deviation %.2f, even choice more than %.2f; %.0f ns a sample\n",
              std::sqrt(variance) / truth, std::sqrt(even_variance) / truth, 1e9 * seconds / samples);
  EXPECT_LT(variance, even_variance / 20);
}

}  // namespace
}  // namespace rnmbake
