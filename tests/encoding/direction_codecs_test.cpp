#include "encoding/codecs/direction_codecs.h"

#include "encoding/ahd.h"
#include "encoding/ambient_cube.h"
#include "encoding/random_light.h"
#include "encoding/refit/refit.h"
#include "encoding/unity_dominant.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

struct Coded {
  std::vector<Vec3> layers;
  EncodeCounts counts;
};

Coded coded(const Codec& codec, const std::vector<Vec3>& irradiance) {
  Coded result{std::vector<Vec3>(3), {}};
  result.counts = codec.encode(irradiance, result.layers);
  return result;
}

/// What the function of the normal gives at flat, rnm0, rnm1 and rnm2.
template <typename At>
std::vector<Vec3> four_of(const At& at) {
  std::vector<Vec3> values;
  for (const BasisDirection& basis : flat_and_rnm().directions) values.push_back(at(basis.direction));
  return values;
}

TEST(AhdCodec, ReturnsItsOwnLight) {
  const auto codec = ahd_codec({"ahd"}, flat_and_rnm());
  const Vec3 ambient(0.2F, 0.3F, 0.4F), directional(1, 0.7F, 0.2F);
  for (const double tilt : {0.1, 0.3, 0.6}) {  // above the horizons of all three of the basis
    const Vec3 direction(direction_at(tilt, 1));
    const auto [layers, counts] =
        coded(*codec, four_of([&](const Vec3& n) { return ahd_decode(ambient, directional, direction, n); }));
    EXPECT_EQ(counts.unconverged, 0U);
    EXPECT_LE((layers[0] - ambient).length(), 1e-4F) << tilt;
    EXPECT_LE((layers[1] - directional).length(), 1e-4F) << tilt;
    EXPECT_LE((layers[2] - direction).length(), 1e-4F) << tilt;
  }
}

TEST(AhdCodec, OfGreyLightReturnsTheFourBakes) {
  std::mt19937 random(1);
  const auto codec = ahd_codec({"ahd"}, flat_and_rnm());
  int returned = 0;
  for (int i = 0; i < 100; ++i) {
    const auto light = bakes(random_hemisphere(random), flat_and_rnm());
    const auto [layers, counts] = coded(*codec, light);
    if (counts.unconverged > 0) continue;
    ++returned;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 decoded = codec->decode(layers, flat_and_rnm().directions[k].direction);
      EXPECT_NEAR(decoded.x, light[k].x, 1e-5 * max_channel(light[0]) + 1e-5) << i;
    }
  }
  EXPECT_GT(returned, 50);
}

TEST(AhdCodec, NothingIsNegative) {
  std::mt19937 random(2);
  const auto codec = ahd_codec({"ahd"}, flat_and_rnm());
  for (int i = 0; i < 200; ++i) {
    const auto light = bakes(random_hemisphere(random), random_hemisphere(random), random_hemisphere(random),
                             flat_and_rnm());
    const auto layers = coded(*codec, light).layers;
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(layers[0][c], -1e-6F * light[0][c]);  // flat less what the highlight takes, rounded
      EXPECT_GE(layers[1][c], 0);
    }
    EXPECT_NEAR(layers[2].length(), 1, 1e-6);
  }
}

TEST(DominantCodec, ReturnsItsOwnLight) {
  const auto codec = dominant_codec({"dominant"}, flat_and_rnm());
  const Vec3 colour(1, 0.5F, 0.25F), d = Vec3(direction_at(0.7, 2)) * 0.6F;
  const auto light = four_of([&](const Vec3& n) { return colour * ((1 + d.dot(n)) / (1 + d.z)); });
  const auto [layers, counts] = coded(*codec, light);
  EXPECT_EQ(counts.out_of_range, 0U);
  EXPECT_LE((layers[0] - colour).length(), 1e-5F);
  EXPECT_LE((layers[1] - (d * 0.5F + Vec3(0.5F))).length(), 1e-5F);
  EXPECT_NEAR(layers[2].x, (1 + d.z) / 2, 1e-5);
}

/// What the decode leaves over the basis, for one colour.
double dominant_left(const std::vector<Vec3>& light, const Vec3d& d) {
  double sum = 0;
  for (std::size_t k = 1; k < 4; ++k) {
    const double error = light[0].x * (1 + d.dot(four_directions()[k])) / (1 + d.z) - light[k].x;
    sum += error * error;
  }
  return sum;
}

TEST(DominantCodec, NoPointOfTheBallIsBetter) {
  std::mt19937 random(3);
  const auto codec = dominant_codec({"dominant"}, flat_and_rnm());
  int beyond = 0;
  for (int i = 0; i < 200; ++i) {
    const auto light = bakes(random_hemisphere(random), flat_and_rnm());
    const auto [layers, counts] = coded(*codec, light);
    const Vec3d d = Vec3d(layers[1]) * 2 - Vec3d(1);
    EXPECT_LE(d.length(), 1 + 1e-6);
    EXPECT_EQ(counts.negative_lobes, 0U);
    if (counts.out_of_range == 0) continue;
    ++beyond;
    double least = std::numeric_limits<double>::infinity();
    for (int ring = 0; ring <= 60; ++ring) {
      for (int around = 0; around < 60; ++around) {
        const Vec3d unit = direction_at(ring * pi / 61, around * pi / 30);
        for (const double length : {0.5, 0.9, 1.0})
          least = std::min(least, dominant_left(light, unit * length));
      }
    }
    // d is a float: 2^-24 of slopes below 4 bakes.
    EXPECT_LE(dominant_left(light, d), least + 1e-6 * light[0].x * light[0].x) << i;
  }
  EXPECT_GT(beyond, 50);
}

TEST(AmbientCube, OfASkyAboveTheSurface) {
  const AmbientCube cube =
      ambient_cube_of([](const Vec3& n) { return Vec3(static_cast<float>(pi) * (1 + n.z) / 2); });
  for (std::size_t side = 0; side < 4; ++side) EXPECT_NEAR(cube[side].x, pi / 2, 1e-6);
  EXPECT_NEAR(cube[4].x, pi, 1e-6);
  EXPECT_NEAR(cube[5].x, 0, 1e-6);
  // Half-way between +z and +x both count one half.
  EXPECT_NEAR(ambient_cube_decode(cube, Vec3(1, 0, 1).normalized()).x, 0.75 * pi, 1e-6);
  EXPECT_NEAR(ambient_cube_decode(cube, Vec3(0, -1, -1).normalized()).x, 0.25 * pi, 1e-6);
}

TEST(AmbientCube, IsExactAtTheAxes) {
  std::mt19937 random(4);
  const Hemisphere light = random_hemisphere(random);
  const auto at = [&](const Vec3& n) { return Vec3(static_cast<float>(irradiance(light, Vec3d(n)))); };
  const AmbientCube cube = ambient_cube_of(at);
  for (const Vec3& axis : ambient_cube_axes()) EXPECT_EQ(ambient_cube_decode(cube, axis), at(axis));
}

}  // namespace
}  // namespace rnmbake
