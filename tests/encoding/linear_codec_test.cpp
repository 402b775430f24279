#include "encoding/codecs/linear_codec.h"

#include "encoding/direction_sets.h"
#include "encoding/fit/least_squares.h"
#include "encoding/hbasis.h"
#include "encoding/random_light.h"
#include "encoding/sg.h"
#include "encoding/sh.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

const std::array<std::string, 5> kLinear{"sh2", "sh3", "h4", "h6", "sg"};

/// The set that the encoding was made for.
BasisSet set_for(const std::string& encoding) {
  return *direction_set(encoding == "sh2" || encoding == "h4" ? "l1" : encoding);
}

std::vector<Vec3> encoded_as(const Codec& codec, const std::vector<Vec3>& irradiance) {
  std::vector<Vec3> layers(codec.layers().size());
  (void)codec.encode(irradiance, layers);
  return layers;
}

TEST(LinearCodec, ReturnsTheCoefficientsOfItsOwnFunctions) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> even(-1, 1);
  for (const std::string& name : kLinear) {
    const BasisSet set = set_for(name);
    const auto codec = linear_codec({name}, set);
    std::vector<Vec3> wanted, irradiance;
    for (std::size_t i = 0; i < codec->layers().size(); ++i)
      wanted.emplace_back(even(random), even(random), even(random));
    for (const BasisDirection& basis : set.directions)
      irradiance.push_back(codec->decode(wanted, basis.direction));
    const auto found = encoded_as(*codec, irradiance);
    // Values are rounded to 2^-24 of about 3, which the fit may grow by its condition number.
    const double bound = 3 * condition_of(name, set) / (1 << 24) * 4;
    for (std::size_t i = 0; i < wanted.size(); ++i)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[i][c], wanted[i][c], bound) << name << ' ' << i;
  }
}

TEST(LinearCodec, AUniformSkyIsExactWhereTheFunctionsAreLinear) {
  for (const std::string name : {"sh2", "sh3", "h4", "h6"}) {
    const BasisSet set = set_for(name);
    std::vector<Vec3> sky;
    for (const BasisDirection& basis : set.directions) sky.emplace_back((1 + basis.direction.z) / 2);
    const auto codec = linear_codec({name}, set);
    const auto layers = encoded_as(*codec, sky);
    for (const double tilt : {0.0, 0.5, 1.0, 1.5}) {
      const Vec3d n(std::sin(tilt), 0, std::cos(tilt));
      EXPECT_NEAR(codec->decode(layers, Vec3(n)).x, (1 + n.z) / 2, 1e-5) << name;
    }
  }
}

// Of the true harmonics of a sun of power 1: 1/4 + 2/3 3/4 + 1/4 5/4.
TEST(LinearCodec, Sh3OfASunSeenStraightOn) {
  const Vec3 d = Vec3(1, 2, 3).normalized();
  const auto harmonics = sh_basis(d);
  std::vector<Vec3> sun;
  for (const float y : harmonics) sun.emplace_back(y * static_cast<float>(pi));
  EXPECT_NEAR(linear_codec({"sh3"}, set_for("sh3"))->decode(sun, d).x, 1.0625, 1e-6);
}

/// Means over a hemisphere of 20,000 points, whose error is below 1 / points for smooth functions.
constexpr std::size_t kPoints = 20000;

TEST(LinearCodec, HBasisIsOrthonormalOverTheHemisphere) {
  std::array<std::array<double, 6>, 6> products{};
  const auto points = spread_over_hemisphere(kPoints);
  for (const Vec3d& point : points) {
    const auto h = h_basis(point);
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) products[i][j] += h[i] * h[j] * 2 * pi / kPoints;
  }
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) EXPECT_NEAR(products[i][j], i == j ? 1 : 0, 1e-3) << i << ' ' << j;
}

TEST(LinearCodec, SgIrradianceIsThatOfQuadrature) {
  const double sharpness = sg_sharpness();
  double whole = 0;
  std::vector<Vec3d> sphere = spread_over_hemisphere(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) sphere.push_back(-sphere[i]);
  const double solid_angle = 2 * pi / kPoints;
  for (const Vec3d& d : sphere) whole += std::exp(sharpness * (d.z - 1)) * solid_angle / pi;
  for (double angle = 0; angle <= 180; angle += 5) {
    const Vec3d normal(std::sin(angle * pi / 180), 0, std::cos(angle * pi / 180));
    double exact = 0;
    for (const Vec3d& d : sphere)
      exact += std::exp(sharpness * (d.z - 1)) * std::max(0.0, d.dot(normal)) * solid_angle / pi;
    // What sg_irradiance() promises of Hill's fit.
    EXPECT_NEAR(sg_irradiance(sharpness, normal.z), exact, 0.008 * whole) << angle;
  }
}

TEST(LinearCodec, SgLobesCrossAtOneHalf) {
  const Vec3d between = (sg_axes()[0] + sg_axes()[1]).normalized();
  for (const std::size_t i : {0, 1})
    EXPECT_NEAR(std::exp(sg_sharpness() * (between.dot(sg_axes()[i]) - 1)), 0.5, 1e-12);
}

TEST(LeastSquares, KeepsOneValueAndErrsLeastAtTheOthers) {
  // A line through (0, 1), and of (1, 2), (2, 6) what is left: slopes 1 and 5/2, weighed by 1 and 4: 11/5.
  const LeastSquares fit({{1, 0}, {1, 1}, {1, 2}}, 0);
  std::array<Vec3, 2> line;
  fit.solve(std::array{Vec3(1), Vec3(2), Vec3(6)}, line);
  EXPECT_NEAR(line[0].x, 1, 1e-6);
  EXPECT_NEAR(line[1].x, 2.2, 1e-6);
}

TEST(LeastSquares, SaysWhatDirectionsDoNotDetermine) {
  EXPECT_TRUE(std::isinf(LeastSquares({{1, 0, 0}, {0, 1, 0}}, 0).condition()));
  EXPECT_GT(LeastSquares({{1, 1}, {2, 2}, {3, 3}}, 0).condition(), 1e12);
  EXPECT_NEAR(LeastSquares({{3, 0}, {0, 1}, {0, 0}}, 0).condition(), 3, 1e-12);
}

TEST(SignedCodec, AUniformSky) {
  const BasisSet set = *direction_set("sh3");
  std::vector<Vec3> sky;
  for (const BasisDirection& basis : set.directions) sky.emplace_back((1 + basis.direction.z) / 2);
  const auto codec = signed_codec({"rnm-signed"}, set);
  for (const Vec3& map : encoded_as(*codec, sky)) EXPECT_NEAR(map.x, 0.57735027, 1e-5);
}

TEST(SignedCodec, IsTheProjectionOfTheLight) {
  std::mt19937 random(2);
  const BasisSet set = *direction_set("sh3");
  const auto codec = signed_codec({"rnm-signed"}, set);
  double error = 0, size = 0;
  for (int i = 0; i < 200; ++i) {
    const Hemisphere light = random_hemisphere(random);
    Vec3d projected(0);
    for (const Sun& sun : light) projected += sun.direction * sun.power;
    const auto maps = encoded_as(*codec, bakes(light, set));
    Vec3d found(0);
    for (std::size_t k = 0; k < 3; ++k) found += Vec3d(rnm_set().directions[k].direction) * maps[k].x;
    EXPECT_NEAR(found.z, projected.z, 1e-5 * projected.z);  // flat is baked
    error += (found - projected).length2();
    size += projected.length2();
  }
  // Band 4 of the irradiance, 1/24 of the light's, is all that passes for band 1 here: the clamped cosine has
  // no band 3. It enters by less than the condition number of the columns involved, 3.
  EXPECT_LT(std::sqrt(error / size), 3.0 / 24);
}

TEST(DirectionSets, HoldTheFourAndDetermineTheirEncodings) {
  for (const char* name : {"l1", "h6", "sg", "sh3"}) {
    const BasisSet set = direction_set(name).value();
    EXPECT_TRUE(check_basis(set).empty()) << name;
    EXPECT_TRUE(holds_rnm(set)) << name;
    EXPECT_TRUE(place_of(set, flat_direction())) << name;
    for (const BasisDirection& basis : set.directions)
      EXPECT_GT(basis.direction.z, 0.17F) << name;  // 80 degrees
  }
  EXPECT_EQ(direction_set("l1")->directions.size(), 7U);
  EXPECT_EQ(direction_set("h6")->directions.size(), 10U);
  EXPECT_EQ(direction_set("sg")->directions.size(), 10U);
  EXPECT_EQ(direction_set("sh3")->directions.size(), 13U);
  EXPECT_FALSE(direction_set("rnm"));
}

TEST(DirectionSets, ConditionsAreAsStated) {
  const auto condition = [](const char* encoding, const char* set) {
    return condition_of(encoding, direction_set(set).value());
  };
  EXPECT_NEAR(condition("sh2", "l1"), 9.6, 0.05);
  EXPECT_NEAR(condition("h4", "l1"), 2.5, 0.05);
  EXPECT_NEAR(condition("h6", "h6"), 2.9, 0.05);
  EXPECT_NEAR(condition("sg", "sg"), 19.1, 0.05);
  EXPECT_NEAR(condition("sh3", "sh3"), 28.4, 0.05);
}

}  // namespace
}  // namespace rnmbake
