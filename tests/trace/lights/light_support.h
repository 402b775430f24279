// trace/lights/light_support.h - small lit scenes, and irradiance by Monte Carlo and by other means.
#pragma once

#include "scene/diffuse_scene.h"
#include "trace/geometry/triangles.h"
#include "trace/lights/lights.h"

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {

inline const Vec3 up(0, 0, 1), tilted = Vec3(0.8F, -0.3F, 0.5F).normalized();
inline const Vec3 nowhere(0, 0, 0);  // no normal: light for a point without a surface

/// Lamps, triangles and a world, with the Lights of them.
struct LitScene {
  DiffuseScene diffuse_scene;
  Triangles triangles;

  LightInfo& lamp(const std::string& type, double energy, std::map<std::string, double> sizes = {}) {
    LightInfo info;
    info.name = info.type = type;
    info.energy = energy;
    info.sizes = std::move(sizes);
    diffuse_scene.survey.lights.push_back(info);
    return diffuse_scene.survey.lights.back();
  }
  int material(const Vec3& emission, int picture = -1) {
    SurfaceMaterial material;
    material.emission = emission;
    material.emission_picture = picture;
    diffuse_scene.materials.push_back(material);
    return static_cast<int>(diffuse_scene.materials.size()) - 1;
  }
  void triangle(int material, const Vec3& a, const Vec3& b, const Vec3& c) {
    for (const Vec3& p : {a, b, c}) triangles.position.push_back(p);
    for (int k = 0; k < 3; ++k) triangles.normal.push_back((b - a).cross(c - a).normalized());
    for (const Vec2& uv : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}) triangles.uv.push_back(uv);
    triangles.material.push_back(static_cast<std::uint32_t>(material));
    triangles.object.push_back(0);
  }
  [[nodiscard]] Lights lights(const std::string& version = "5.2.2") const {
    return {diffuse_scene, triangles, version};
  }
};

inline Vec3d row(const Mat44& matrix, int index) {
  return {matrix[index][0], matrix[index][1], matrix[index][2]};
}

struct Estimate {
  double mean = 0, error = 0;  // standard error
};

/// What a surface gets, red channel. Each seed's samples are jittered over the light; the choice is random.
inline Estimate irradiance(const Lights& lights, const Vec3& point, const Vec3& normal,
                           bool tell_normal = true, int seeds = 48, int grid = 64) {
  double sum = 0, squares = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    const auto next = [&] { return static_cast<float>(random() >> 8) * 0x1p-24F; };
    double total = 0;
    for (int i = 0; i < grid * grid; ++i) {
      const int line = i / grid;
      const Vec3 u(next(), (static_cast<float>(line) + next()) / static_cast<float>(grid),
                   (static_cast<float>(i % grid) + next()) / static_cast<float>(grid));
      const LightSample sample = lights.sample(point, tell_normal ? normal : Vec3(0, 0, 0), u);
      const float cosine = sample.direction.dot(normal);
      if (sample.pdf > 0 && cosine > 0) total += double(sample.radiance.x) * cosine / sample.pdf;
    }
    total /= grid * grid;
    sum += total;
    squares += total * total;
  }
  const double mean = sum / seeds;
  return {mean, std::sqrt(std::max(squares / seeds - mean * mean, 0.0) / (seeds - 1))};
}

/// Within four standard errors, which must tell an error of 0.1 % from none.
inline void expect_irradiance(const Lights& lights, const Vec3& point, const Vec3& normal, double truth,
                              const std::string& what, bool tell_normal = true) {
  Estimate seen = irradiance(lights, point, normal, tell_normal);
  for (int seeds = 192; seen.error > 2.5e-4 * truth && seeds < 10000; seeds *= 4) {
    seen = irradiance(lights, point, normal, tell_normal, seeds);
  }
  EXPECT_LE(seen.error, 2.5e-4 * truth) << what;
  // Below this, floats differ.
  EXPECT_NEAR(seen.mean, truth, std::max(4 * seen.error, 2e-5 * truth)) << what << " +- " << seen.error;
}

/// E of a polygon of radiance 1 (Lambert), clipped to the surface's horizon.
inline double polygon_irradiance(const std::vector<Vec3d>& corners, const Vec3d& point, const Vec3d& normal) {
  std::vector<Vec3d> above;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3d a = corners[i] - point, b = corners[(i + 1) % corners.size()] - point;
    const double ha = a.dot(normal), hb = b.dot(normal);
    if (ha >= 0) above.push_back(a);
    if ((ha < 0) != (hb < 0)) above.push_back(a + (b - a) * (ha / (ha - hb)));
  }
  Vec3d sum(0, 0, 0);
  for (std::size_t i = 0; i < above.size(); ++i) {
    const Vec3d a = above[i].normalized(), b = above[(i + 1) % above.size()].normalized();
    const Vec3d across = a.cross(b);
    if (across.length() > 0) sum += across.normalized() * std::atan2(across.length(), a.dot(b));
  }
  return std::abs(sum.dot(normal)) / 2;
}

/// Integral over the unit sphere, by an even grid of the cosine and the angle around `axis`.
inline double over_sphere(const Vec3& axis, const std::function<double(const Vec3&)>& value, int steps = 700,
                          double from_cosine = -1) {
  const Vec3d z = Vec3d(axis).normalized();
  const Vec3d x = (std::abs(z.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0)).cross(z).normalized(),
              y = z.cross(x);
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double c = from_cosine + (1 - from_cosine) * (i + 0.5) / steps, s = std::sqrt(1 - c * c);
    for (int j = 0; j < 2 * steps; ++j) {
      const double angle = pi * (j + 0.5) / steps;
      sum += value(Vec3(x * (s * std::cos(angle)) + y * (s * std::sin(angle)) + z * c));
    }
  }
  return sum * 2 * pi * (1 - from_cosine) / (2.0 * steps * steps);
}

}  // namespace rnmbake
