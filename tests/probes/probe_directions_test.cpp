#include "probes/probe_directions.h"

#include "encoding/ambient_cube.h"
#include "encoding/distant_light.h"
#include "encoding/sh.h"
#include "probes/probe_volume.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

double mean_over_directions(const std::function<double(const Vec3&)>& value) {
  double sum = 0;
  for (std::size_t i = 0; i < probe_direction_count; ++i)
    sum += double(probe_direction_weights()[i]) * value(probe_directions()[i]);
  return sum;
}

/// Mean of x^a y^b z^c over the sphere: 0 where a power is odd, else (a-1)!! (b-1)!! (c-1)!! / (a+b+c+1)!!.
double mean_over_sphere(int a, int b, int c) {
  if (a % 2 != 0 || b % 2 != 0 || c % 2 != 0) return 0;
  const auto odd_product = [](int n) {
    double product = 1;
    for (int i = n; i > 1; i -= 2) product *= i;
    return product;
  };
  return odd_product(a - 1) * odd_product(b - 1) * odd_product(c - 1) / odd_product(a + b + c + 1);
}

TEST(ProbeDirections, MeansAreExactUpToDegreeFive) {
  for (int a = 0; a <= 5; ++a) {
    for (int b = 0; a + b <= 5; ++b) {
      for (int c = 0; a + b + c <= 5; ++c) {
        const double mean = mean_over_directions([&](const Vec3& d) {
          return std::pow(double(d.x), a) * std::pow(double(d.y), b) * std::pow(double(d.z), c);
        });
        EXPECT_NEAR(mean, mean_over_sphere(a, b, c), 1e-7) << a << b << c;
      }
    }
  }
}

TEST(ProbeDirections, AxesAreThoseOfAnAmbientCube) {
  for (std::size_t side = 0; side < 6; ++side) EXPECT_EQ(probe_directions()[side], ambient_cube_axes()[side]);
  for (const Vec3& direction : probe_directions()) EXPECT_NEAR(direction.length(), 1, 1e-6);
}

PerProbeDirection<Vec3> irradiance_by(const std::array<Vec3, 9>& harmonics) {
  PerProbeDirection<Vec3> light;
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = irradiance_of(harmonics, probe_directions()[i]);
  return light;
}

TEST(ProbeDirections, HarmonicsComeBack) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> number(-1, 1);
  std::array<Vec3, 9> harmonics;
  for (Vec3& one : harmonics) one = Vec3(number(random), number(random), number(random));
  const auto found = harmonics_of(irradiance_by(harmonics));
  for (std::size_t k = 0; k < 9; ++k)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[k][c], harmonics[k][c], 2e-6) << k;
}

/// A uniform sky over the upper half: E/pi = (1 + z) / 2 at any normal, which is of bands 0 and 1 alone. Its
/// ambient cube is (1/2 four times, 1, 0): irradiance pi / 2, pi and 0.
TEST(ProbeDirections, HemisphereOfSky) {
  PerProbeDirection<Vec3> light;
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = Vec3((1 + probe_directions()[i].z) / 2);
  const auto harmonics = harmonics_of(light);
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0.6F, 0, -0.8F)})
    EXPECT_NEAR(irradiance_of(harmonics, normal).x, (1 + normal.z) / 2, 1e-6);
  const AmbientCube cube{light[0], light[1], light[2], light[3], light[4], light[5]};
  EXPECT_NEAR(ambient_cube_decode(cube, {0, 0, 1}).x * pi, pi, 1e-6);
  EXPECT_NEAR(ambient_cube_decode(cube, {-1, 0, 0}).x * pi, pi / 2, 1e-6);
  EXPECT_EQ(ambient_cube_decode(cube, {0, 0, -1}).x, 0);
}

/// A unit sun has the greatest share of bands that its 14 values cannot tell apart. The true coefficients
/// give 1.0625 towards it (bands 0 to 2); those of the values differ by what band 4 and above add, which for
/// a sun is at most 0.0625 of E (the rest of the series of the clamped cosine beyond band 2).
TEST(ProbeDirections, HarmonicsOfASun) {
  std::mt19937 random(2);
  std::normal_distribution<float> number;
  for (int i = 0; i < 100; ++i) {
    DistantLight sun;
    sun.add(unit(Vec3(number(random), number(random), number(random))), Vec3(1));
    PerProbeDirection<Vec3> light;
    std::ranges::copy(irradiance(sun, Vec3(0), probe_directions()), light.begin());
    const auto found = harmonics_of(light);
    const auto basis = sh_basis(sun.directions[0]);
    std::array<Vec3, 9> exact;
    for (std::size_t k = 0; k < 9; ++k) exact[k] = Vec3(float(pi) * basis[k]);
    EXPECT_NEAR(irradiance_of(exact, sun.directions[0]).x, 1.0625, 1e-5);
    EXPECT_NEAR(irradiance_of(exact, sun.directions[0], 2).x, 0.75, 1e-5);
    double square = 0;
    for (std::size_t k = 0; k < 9; ++k) {
      const double error = double(found[k].x - exact[k].x) * double(sh_cosine_over_pi[k == 0  ? 0
                                                                                      : k < 4 ? 1
                                                                                              : 2]);
      square += error * error / (4 * pi);
    }
    EXPECT_LT(std::sqrt(square), 0.0625) << i;  // RMS over all normals
  }
}

TEST(ProbeGrid, CoordinatesOfItsPlaces) {
  ProbeGrid grid;
  grid.counts = {3, 4, 5};
  grid.first = {10, -2, 1};
  grid.steps = {Vec3d(0, 2, 0), Vec3d(-1, 0, 0.5), Vec3d(0.2, 0, 3)};
  const Vec3d found = grid.coordinates(grid.place(2, 3, 4));
  EXPECT_NEAR(found.x, 2, 1e-12);
  EXPECT_NEAR(found.y, 3, 1e-12);
  EXPECT_NEAR(found.z, 4, 1e-12);
  EXPECT_EQ(grid.size(), 60U);
  EXPECT_EQ(grid.index(2, 3, 4), 59U);
}

}  // namespace
}  // namespace rnmbake
