#include "ssbump/map/slope_curl.h"

#include "ssbump/nms_support.h"

#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Normals from slopes p = dh/dx and q = dh/dy, by column and row.
template <typename Slopes>
FloatImage normals_of_slopes(int width, int height, Slopes slopes) {
  FloatImage normals(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto [p, q] = slopes(x, y);
      const Vec3 n = unit(Vec3(static_cast<float>(-p), static_cast<float>(-q), 1));
      std::ranges::copy(std::array{n.x, n.y, n.z}, normals.texel(x, y).begin());
    }
  }
  return normals;
}

TEST(SlopeCurl, NothingOfASurfaceAtEveryScale) {
  const FloatImage normals = normals_of_field(waves(64, 48));
  for (const int scale : {1, 4, 16}) {
    const SlopeCurl curl = slope_curl(normals, {.scale = scale});
    EXPECT_EQ(curl.places, std::size_t(64 / scale) * (48 / scale));
    EXPECT_LT(curl.relative, 1e-4) << scale;
    EXPECT_LT(curl.worst, 1e-5) << scale;
    EXPECT_EQ(curl.share_above, 0) << scale;
  }
}

/// h_xy is all there is of both derivatives, so a turned green channel doubles what should cancel.
TEST(SlopeCurl, ATurnedGreenChannelIsAllCurl) {
  FloatImage normals = normals_of_field(waves(64, 64));
  const SlopeCurl right = slope_curl(normals, {});
  EXPECT_NEAR(right.relative_flipped, std::sqrt(2), 1e-4);
  for (std::size_t i = 1; i < normals.data().size(); i += 3) normals.data()[i] *= -1;
  const SlopeCurl wrong = slope_curl(normals, {});
  EXPECT_NEAR(wrong.relative, std::sqrt(2), 1e-4);
  EXPECT_LT(wrong.relative_flipped, 1e-4);
}

/// Slopes that go round a centre: dp/dy = -k and dq/dx = k everywhere.
TEST(SlopeCurl, AWhirlHasItsCurl) {
  constexpr double k = 0.01;
  const FloatImage normals =
      normals_of_slopes(40, 40, [](int x, int y) { return std::pair(-k * (20 - y), k * (x - 20)); });
  for (const int scale : {1, 4}) {
    const SlopeCurl curl = slope_curl(normals, {.border = Border::clamp, .bound = 0.019, .scale = scale});
    EXPECT_NEAR(curl.rms, 2 * k, 1e-5);
    EXPECT_NEAR(curl.worst, 2 * k, 1e-5);
    EXPECT_NEAR(curl.relative, std::sqrt(2), 1e-4);
    EXPECT_EQ(curl.share_above, 1);
  }
}

/// Independent slopes of variance s^2: central differences have s^2 / 2 each, the curl s^2.
TEST(SlopeCurl, SlopesThatHaveNothingToDoWithEachOther) {
  constexpr int side = 256;
  std::mt19937 random(3);
  std::normal_distribution<double> slope(0, 0.2);
  const FloatImage normals =
      normals_of_slopes(side, side, [&](int, int) { return std::pair(slope(random), slope(random)); });
  const SlopeCurl curl = slope_curl(normals, {});
  // The square of a normal number has the relative variance 2, and each of four neighbours two texels away
  // correlates by -1/4: the sum of squared correlations is 5/4. A root has half the relative error.
  const double error = 0.5 * std::sqrt(2 * 1.25) / side;
  EXPECT_NEAR(curl.rms, 0.2, 0.2 * 4.5 * error);
  EXPECT_NEAR(curl.relative, 1, 4.5 * std::sqrt(2.0) * error);  // two such means
}

TEST(SlopeCurl, NamesTheWorstTexel) {
  FloatImage normals = normals_of_field(waves(32, 32));
  const Vec3 odd = unit(Vec3(-2, 0, 1));
  std::ranges::copy(std::array{odd.x, odd.y, odd.z}, normals.texel(20, 9).begin());
  const SlopeCurl curl = slope_curl(normals, {});
  EXPECT_EQ(curl.worst_x, 20);
  EXPECT_EQ(std::abs(curl.worst_y - 9), 1);  // the neighbours above and below have it in dp/dy
  EXPECT_NEAR(curl.share_above * 32 * 32, 2, 2);
}

TEST(SlopeCurl, SmallMaps) {
  EXPECT_EQ(slope_curl(even_normals(1, 1, {0, 0, 1}), {}).rms, 0);
  EXPECT_EQ(slope_curl(even_normals(2, 2, {0, 0, 1}), {.border = Border::clamp}).places, 0);
}

}  // namespace
}  // namespace rnmbake
