#include "encoding/rnm.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

constexpr float kExact = 1e-6F;

const std::array<Vec3, 3> kMaps{Vec3(1, 0, 0.25F), Vec3(0, 1, 0.5F), Vec3(0, 0, 2)};

Vec3 random_normal_above(std::mt19937& random) {
  std::normal_distribution<float> gauss;
  Vec3 n(gauss(random), gauss(random), gauss(random));
  n.normalize();
  n.z = std::abs(n.z);
  return n;
}

void expect_near(const Vec3& a, const Vec3& b, float tolerance = kExact) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

/// (1 + n.z) / 2: E/pi of a uniform sky of radiance 1.
std::array<float, 3> sky_maps() {
  const auto basis = rnm_basis();
  return {(1 + basis[0].z) / 2, (1 + basis[1].z) / 2, (1 + basis[2].z) / 2};
}

TEST(Rnm, BasisIsOrthonormalAndOneThirdUp) {
  const auto basis = rnm_basis();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(basis[i].dot(basis[j]), i == j ? 1 : 0, kExact);
    EXPECT_NEAR(basis[i].z, 0.577350F, kExact);
  }
  expect_near(basis[0], {0.816497F, 0, 0.577350F});
  expect_near(basis[1], {-0.408248F, 0.707107F, 0.577350F});
  expect_near(basis[2], {-0.408248F, -0.707107F, 0.577350F});
}

TEST(Rnm, FlatNormalWeighsAThirdEach) {
  for (const float weight : rnm_squared_weights({0, 0, 1})) EXPECT_NEAR(weight, 1 / 3.0, kExact);
  expect_near(rnm_decode_squared(kMaps, {0, 0, 1}), {1 / 3.0F, 1 / 3.0F, 2.75F / 3});
}

TEST(Rnm, NormalOnABasisVectorReturnsThatMapAlone) {
  for (std::size_t i = 0; i < 3; ++i) {
    expect_near(rnm_decode_squared(kMaps, rnm_basis()[i]), kMaps[i]);
    expect_near(rnm_decode_linear(kMaps, rnm_basis()[i]), kMaps[i]);
  }
}

// The field's hand-worked example: half-way between two basis vectors both dots are cos 45 = 0.7071. Linear
// weights sum to 1.414 (too bright); squared they are 0.5 and 0.5.
TEST(Rnm, HalfWayBetweenTwoVectorsSquaredWeightsSumToOne) {
  const auto basis = rnm_basis();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const Vec3 normal = (basis[i] + basis[j]).normalized();
    const auto squared = rnm_squared_weights(normal), linear = rnm_linear_weights(normal);
    EXPECT_NEAR(squared[i], 0.5, kExact);
    EXPECT_NEAR(squared[j], 0.5, kExact);
    EXPECT_NEAR(squared[k], 0, kExact);
    EXPECT_NEAR(linear[i], 0.70710678, kExact);
    EXPECT_NEAR(linear[i] + linear[j] + linear[k], 1.41421356, kExact);
  }
}

TEST(Rnm, SquaresSumToOneBeforeTheClampAndAreRenormalisedBeyond) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 normal = random_normal_above(random);
    const auto weights = rnm_squared_weights(normal);
    EXPECT_NEAR(weights[0] + weights[1] + weights[2], 1, 3e-6);
    float sum = 0;
    for (const float weight : rnm_linear_weights(normal)) sum += weight * weight;
    const bool is_clamped = normal.z < std::cos(35.2 * pi / 180);
    EXPECT_NEAR(is_clamped ? 1 : sum, 1, kExact);
    EXPECT_LE(sum, 1 + kExact);
  }
}

TEST(Rnm, NormalUnderTheSurfaceHasNoWeights) {
  for (const float weight : rnm_squared_weights({0, 0, -1})) EXPECT_EQ(weight, 0);
}

TEST(Rnm, UniformSkyFlatNormal) {
  EXPECT_NEAR(rnm_decode_squared(sky_maps(), {0, 0, 1}), 0.78867513, kExact);
  EXPECT_NEAR(rnm_decode_linear(sky_maps(), {0, 0, 1}), 3 * 0.57735027 * 0.78867513, kExact);
}

TEST(Rnm, OverheadSunFlatNormal) {
  std::array<float, 3> maps{};
  for (std::size_t i = 0; i < 3; ++i) maps[i] = std::max(0.0F, Vec3(0, 0, 1).dot(rnm_basis()[i]));
  EXPECT_NEAR(rnm_decode_squared(maps, {0, 0, 1}), 0.57735027, kExact);
  EXPECT_NEAR(rnm_decode_linear(maps, {0, 0, 1}), 1, kExact);  // sum of squared dots
}

TEST(Rnm, ScaledMapsDecodeAFlatNormalToFlat) {
  const auto scaled = rnm_scaled_to_flat({0.2F, 0.7F, 1.3F}, 0.9F);
  EXPECT_NEAR(rnm_decode_squared(scaled, {0, 0, 1}), 0.9, kExact);
  EXPECT_NEAR(scaled[1] / scaled[0], 3.5, 1e-5);
}

TEST(Rnm, ThreeZerosTakeTheFlatValue) {
  const auto scaled = rnm_scaled_to_flat({0, 0, 0}, 0.4F);
  EXPECT_NEAR(rnm_decode_squared(scaled, {0, 0, 1}), 0.4, kExact);
  EXPECT_EQ(rnm_scaled_to_flat({0, 0, 0}, 0)[0], 0);
}

}  // namespace
}  // namespace rnmbake
