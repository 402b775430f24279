// encoding/random_light.h - hemispheres of light as sums of suns, whose irradiance is exact for every normal.
#pragma once

#include "base/math.h"
#include "encoding/basis_set.h"

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace rnmbake {

/// E/pi of a sun for a surface that faces it, and where it stands.
struct Sun {
  Vec3d direction;
  double power = 0;
};

/// One colour of a texel's light, from above the surface.
using Hemisphere = std::vector<Sun>;

/// Half of the points of a spiral over the sphere, evenly spread: Gonzalez (2010). Solid angle 2 pi / count
/// each.
inline std::vector<Vec3d> spread_over_hemisphere(std::size_t count) {
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double azimuth = static_cast<double>(i) * pi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
    points.emplace_back(r * std::cos(azimuth), r * std::sin(azimuth), z);
  }
  return points;
}

inline double irradiance(const Hemisphere& light, const Vec3d& normal) {
  double sum = 0;
  for (const Sun& sun : light) sum += sun.power * std::max(0.0, sun.direction.dot(normal));
  return sum;
}

/// A sky of radiance up to 1 and one to four lobes exp(k (D.axis - 1)): axes even over the hemisphere, k from
/// 2 to 200 and powers, each, even in the logarithm: a lobe alone gives a surface that faces it an E/pi of
/// 0.1 to 10.
inline Hemisphere random_hemisphere(std::mt19937& random, std::size_t suns = 512) {
  std::uniform_real_distribution<double> even(0, 1);
  const double sky = even(random);
  Hemisphere light;
  for (const Vec3d& point : spread_over_hemisphere(suns))
    light.push_back({point, 2 * sky / static_cast<double>(suns)});
  const int lobes = 1 + static_cast<int>(even(random) * 4);
  for (int i = 0; i < lobes; ++i) {
    const double z = even(random), azimuth = 2 * pi * even(random), r = std::sqrt(1 - z * z);
    const Vec3d axis(r * std::cos(azimuth), r * std::sin(azimuth), z);
    const double sharpness = 2 * std::pow(100, even(random)), power = 0.1 * std::pow(100, even(random));
    double whole = 0;
    for (const Sun& sun : light) whole += std::exp(sharpness * (sun.direction.dot(axis) - 1));
    for (Sun& sun : light) sun.power += power / whole * std::exp(sharpness * (sun.direction.dot(axis) - 1));
  }
  return light;
}

/// A unit vector, even over the sphere.
inline Vec3d random_direction(std::mt19937& random) {
  std::normal_distribution<double> gauss;
  return Vec3d(gauss(random), gauss(random), gauss(random)).normalized();
}

/// E/pi at each direction of the set; a colour each for R, G and B.
inline std::vector<Vec3> bakes(const Hemisphere& r, const Hemisphere& g, const Hemisphere& b,
                               const BasisSet& set) {
  std::vector<Vec3> values;
  for (const BasisDirection& basis : set.directions) {
    const Vec3d n(basis.direction);
    values.emplace_back(Vec3d(irradiance(r, n), irradiance(g, n), irradiance(b, n)));
  }
  return values;
}

inline std::vector<Vec3> bakes(const Hemisphere& grey, const BasisSet& set) {
  return bakes(grey, grey, grey, set);
}

}  // namespace rnmbake
