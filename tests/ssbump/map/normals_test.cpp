#include "ssbump/map/normals.h"

#include "base/math.h"
#include "encoding/rnm.h"
#include "ssbump/map/combine.h"
#include "ssbump/map/weights.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

Vec3 vec(std::span<const float> texel) {
  return {texel[0], texel[1], texel[2]};
}

Vec3 random_normal(std::mt19937& random, float most_tilt) {
  const float turn = std::uniform_real_distribution<float>(0, 6.2831853F)(random);
  const float tilt = std::uniform_real_distribution<float>(0, most_tilt)(random);
  return {std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
}

FloatImage normal_image(const std::vector<Vec3>& normals, int width) {
  FloatImage image(width, static_cast<int>(normals.size()) / width, 3);
  for (std::size_t i = 0; i < normals.size(); ++i)
    for (int c = 0; c < 3; ++c) image.data()[3 * i + c] = normals[i][c];
  return image;
}

FloatImage random_weights(int side, int seed) {
  FloatImage weights(side, side, SsbumpWeights::channels);
  std::mt19937 random(seed);
  for (float& value : weights.data()) value = std::uniform_real_distribution<float>(0.05F, 1)(random);
  return weights;
}

TEST(HeightNormals, OfAPlaneAreItsOwnAndYIsUp) {
  HeightField field{FloatImage(9, 7, 1), WrapMode::none, WrapMode::none};
  for (int y = 0; y < 7; ++y)  // rises to the right and up the picture
    for (int x = 0; x < 9; ++x)
      field.heights.texel(x, y)[0] = 0.5F * static_cast<float>(x) - 0.25F * static_cast<float>(y);
  const FloatImage normals = height_normals(field, 2, 5);
  const Vec3 expected = unit(Vec3(-0.5F, -0.25F, 1));
  for (int y = 0; y < 3; ++y) EXPECT_LT((vec(normals.texel(4, y)) - expected).length(), 1e-6);
}

/// Below 35 degrees no axis is behind the normal, and the three dot products hold all of it.
TEST(BentNormals, OfANormalMapAreThatMapAgain) {
  std::mt19937 random(1);
  std::vector<Vec3> normals;
  for (int i = 0; i < 64; ++i) normals.push_back(random_normal(random, 0.61F));
  const FloatImage bent = bent_normals(weights_of_normals(normal_image(normals, 8)));
  for (std::size_t i = 0; i < normals.size(); ++i)
    EXPECT_LT(
        (Vec3(bent.data()[3 * i], bent.data()[3 * i + 1], bent.data()[3 * i + 2]) - normals[i]).length(),
        1e-6);
}

TEST(WeightsOfNormals, AreOneInTheOpenAndTheLinearDecodeElsewhere) {
  const FloatImage flat = weights_of_normals(normal_image({Vec3(0, 0, 1)}, 1));
  for (const float value : flat.data()) EXPECT_NEAR(value, 1, 1e-6);
  const FloatImage along = weights_of_normals(normal_image({rnm_basis()[1]}, 1));
  EXPECT_NEAR(along.data()[0], 0, 1e-6);
  EXPECT_NEAR(along.data()[1], std::sqrt(3.0), 1e-5);
  EXPECT_NEAR(along.data()[2], 0, 1e-6);
}

TEST(Combine, EvenlyLeavesEveryBentNormalAlone) {
  FloatImage weights = random_weights(16, 1);
  const FloatImage before = bent_normals(weights), whole = weights;
  combine_detail(weights, random_weights(8, 2), 3, Combine::even);
  const FloatImage after = bent_normals(weights);
  double moved = 0;
  for (std::size_t i = 0; i < before.data().size(); ++i) {
    EXPECT_NEAR(before.data()[i], after.data()[i], 2e-7);
    moved = std::max<double>(moved, std::abs(whole.data()[i] - weights.data()[i]));
  }
  EXPECT_GT(moved, 0.3);  // while the light changes
}

TEST(Combine, ByChannelsTurnsThem) {
  FloatImage weights = random_weights(16, 1);
  const FloatImage before = bent_normals(weights);
  combine_detail(weights, random_weights(8, 2), 2, Combine::channels);
  const FloatImage after = bent_normals(weights);
  double turned = 0;
  for (int x = 0; x < 16; ++x)
    turned = std::max<double>(turned, (vec(before.texel(x, 3)) - vec(after.texel(x, 3))).length());
  EXPECT_GT(turned, 0.1);
}

TEST(Combine, LeavesAMapAloneUnderAnOpenDetail) {
  FloatImage weights = random_weights(8, 4), open(2, 2, SsbumpWeights::channels);
  for (float& value : open.data()) value = 1;
  const FloatImage before = weights;
  combine_detail(weights, open, 5, Combine::even);
  for (std::size_t i = 0; i < before.data().size(); ++i)
    EXPECT_NEAR(weights.data()[i], before.data()[i], 1e-6);
}

}  // namespace
}  // namespace rnmbake
