#include "ssbump/map/mips.h"

#include "base/math.h"
#include "encoding/rnm.h"
#include "ssbump/map/normals.h"
#include "ssbump/map/weights.h"

#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

double mean_of(const FloatImage& image) {
  return std::accumulate(image.data().begin(), image.data().end(), 0.0) /
         static_cast<double>(image.data().size());
}

TEST(HalfSize, KeepsTheMeanAtAnySize) {
  std::mt19937 random(2);
  for (const auto& [width, height] : {std::pair(8, 8), std::pair(7, 5), std::pair(1, 9), std::pair(13, 1)}) {
    FloatImage image(width, height, 1);
    for (float& value : image.data()) value = std::uniform_real_distribution<float>(0, 1)(random);
    const double before = mean_of(image);
    for (int level = mip_levels(width, height); level > 0; --level) image = half_size(image);
    ASSERT_EQ(image.texels(), 1U);
    EXPECT_NEAR(image.data()[0], before, 1e-5) << width << "x" << height;
  }
  EXPECT_EQ(mip_levels(1, 1), 0);
  EXPECT_EQ(mip_levels(7, 5), 2);
}

/// Bumps, as unit normals up to about 50 degrees off.
FloatImage bumpy_normals(int side) {
  HeightField field{FloatImage(side, side, 1), WrapMode::wrap, WrapMode::wrap};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x)
      field.heights.texel(x, y)[0] =
          static_cast<float>(1.5 * std::sin(2 * pi * x * 8 / side) * std::cos(2 * pi * y * 8 / side));
  }
  return height_normals(field, 0, side);
}

FloatImage smaller(FloatImage image, int levels) {
  for (int i = 0; i < levels; ++i) image = half_size(image);
  return image;
}

/// What a shader gets from a light: for weights of the texel, for a normal.
float lit(std::span<const float> w, const std::array<float, 3>& maps) {
  return (w[0] * maps[0] + w[1] * maps[1] + w[2] * maps[2]) * rnm_basis()[0].z;
}
float lit_normal(const Vec3& n, const std::array<float, 3>& maps) {
  return rnm_decode_linear(maps, n);
}

struct Errors {
  double weights = 0, normals = 0;
};

/// RMS over texels and lights of a mip level's light against the mean of the full map's.
Errors errors_of(int levels) {
  const FloatImage normals = bumpy_normals(64), weights = weights_of_normals(normals);
  const FloatImage mip_weights = smaller(weights, levels), mip_normals = smaller(normals, levels);
  Errors errors;
  std::mt19937 random(5);
  for (int light = 0; light < 32; ++light) {
    const float turn = std::uniform_real_distribution<float>(0, 6.28F)(random),
                z = (static_cast<float>(light) + 0.5F) / 32;
    const float r = std::sqrt(1 - z * z);
    const auto maps = rnm_linear_weights({r * std::cos(turn), r * std::sin(turn), z});
    FloatImage shaded(64, 64, 1);
    for (std::size_t i = 0; i < shaded.data().size(); ++i) {
      const float* n = &normals.data()[3 * i];
      shaded.data()[i] = lit_normal({n[0], n[1], n[2]}, maps);
    }
    const FloatImage truth = smaller(shaded, levels);
    for (std::size_t i = 0; i < truth.data().size(); ++i) {
      const float* n = &mip_normals.data()[3 * i];
      const float* w = &mip_weights.data()[SsbumpWeights::channels * i];
      errors.weights += std::pow(lit({w, 3}, maps) - truth.data()[i], 2);
      errors.normals += std::pow(lit_normal(unit(Vec3(n[0], n[1], n[2])), maps) - truth.data()[i], 2);
    }
  }
  const double count = 32.0 * static_cast<double>(mip_weights.texels());
  return {std::sqrt(errors.weights / count), std::sqrt(errors.normals / count)};
}

TEST(HalfSize, OfWeightsLightsAsTheMeanAndOfNormalsDoesNot) {
  for (const int levels : {1, 2, 3, 4}) {
    const Errors errors = errors_of(levels);
    EXPECT_LT(errors.weights, 1e-6) << levels;
    RecordProperty("level" + std::to_string(levels), std::to_string(errors.normals));
  }
  EXPECT_GT(errors_of(3).normals, 0.05);
}

}  // namespace
}  // namespace rnmbake
