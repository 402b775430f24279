#include "ssbump/heights/height_shadows.h"

#include "ssbump/nms_support.h"

#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

constexpr double least_slope = 0.01;

/// The bilinear surface, looked up anywhere.
double surface(const HeightField& field, double x, double y) {
  const auto at = [&](int i, int j) {
    const auto fold = [](int k, int size) { return (k % size + size) % size; };
    return double(field.heights.texel(fold(i, field.width()), fold(j, field.height()))[0]);
  };
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double u = x - i, v = y - j;
  return (1 - v) * ((1 - u) * at(i, j) + u * at(i + 1, j)) +
         v * ((1 - u) * at(i, j + 1) + u * at(i + 1, j + 1));
}

TEST(HeightShadows, HorizonIsTheHighestOfAllPointsOnTheWay) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> height(0, 4);
  const HeightField field = field_of(16, 12, [&](int, int) { return height(random); });
  const HeightRays rays(field);
  for (const double degrees : {0.0, 17.0, 45.0, 90.0, 133.0, 180.0, 222.0, 301.0}) {
    const Vec2 azimuth(static_cast<float>(std::cos(degrees * pi / 180)),
                       static_cast<float>(std::sin(degrees * pi / 180)));
    for (const int x : {0, 7, 15}) {
      const double start = field.heights.texel(x, 5)[0];
      double dense = 0.2;
      for (int i = 1; i / 512.0 < 4 / dense; ++i) {
        const double t = i / 512.0;
        dense = std::max(dense, (surface(field, x + azimuth.x * t, 5 - azimuth.y * t) - start) / t);
      }
      const double exact = rays.horizon_slope(x, 5, azimuth, 0.2);
      EXPECT_GE(exact, dense - 1e-5) << degrees << ", " << x;
      // A peak lies at most half of 1/512 beside a sample and one texel away; no slope is above 4 sqrt(2).
      EXPECT_LE(exact, dense + 2 * 4 * std::sqrt(2.0) / 1024) << degrees << ", " << x;
    }
  }
}

TEST(HeightShadows, AWallCastsAShadowOfKnownLength) {
  constexpr int wall = 40;
  HeightField field = field_of(64, 8, [](int x, int) { return x >= wall ? 10 : 0; });
  field.x = WrapMode::none;
  for (const double azimuth : {0.0, 30.0, -60.0}) {
    for (const double elevation : {20.0, 35.0, 50.0}) {
      const FloatImage seen = height_shadows(field, light_from(azimuth, elevation));
      const double length = 10 / std::tan(elevation * pi / 180) * std::cos(azimuth * pi / 180);
      for (int x = 0; x < wall; ++x)
        EXPECT_EQ(seen.texel(x, 3)[0], wall - x > length ? 1 : 0)
            << azimuth << ", " << elevation << ", " << x;
      EXPECT_EQ(seen.texel(wall, 3)[0], 1);
    }
  }
}

/// Over the patch beside a spike of height H the diagonal rises as H u^2.
TEST(HeightShadows, ASpikeSeenAlongTheDiagonal) {
  HeightField field = field_of(16, 16, [](int x, int y) { return x == 8 && y == 8 ? 6 : 0; });
  field.x = field.y = WrapMode::none;
  const float half = std::sqrt(0.5F);
  const HeightRays rays(field);
  EXPECT_NEAR(rays.horizon_slope(6, 10, {half, half}, least_slope), 6 / (2 * std::sqrt(2)),
              1e-6);  // y up: from below
  EXPECT_NEAR(rays.horizon_slope(7, 9, {half, half}, least_slope), 6 / std::sqrt(2), 1e-6);
  EXPECT_EQ(rays.horizon_slope(10, 6, {half, half}, least_slope), least_slope);
  EXPECT_EQ(rays.horizon_slope(6, 10, {half, -half}, least_slope), least_slope);
}

/// Between (0, 4) and (4, 0) a patch hangs like a saddle: along its diagonal the middle is the highest.
TEST(HeightShadows, TheTopOfASaddleLiesWithinThePatch) {
  HeightField field =
      field_of(4, 4, [](int x, int y) { return (x == 1 && y == 2) || (x == 2 && y == 1) ? 4 : 0; });
  field.x = field.y = WrapMode::none;
  const float half = std::sqrt(0.5F);
  // From (0, 0) down the picture: f = 8 u (1 - u) at distance sqrt 2 (1 + u).
  double best = 0;
  for (int i = 0; i <= 100000; ++i) {
    const double u = i * 1e-5;
    best = std::max(best, 8 * u * (1 - u) / (std::sqrt(2) * (1 + u)));
  }
  EXPECT_NEAR(HeightRays(field).horizon_slope(0, 0, {half, -half}, least_slope), best, 1e-6);
}

TEST(HeightShadows, BeyondTheBorder) {
  HeightField field = field_of(16, 4, [](int x, int) { return x == 1 ? 8 : 0; });
  const Vec2 right(1, 0);
  field.x = WrapMode::wrap;
  EXPECT_NEAR(HeightRays(field).horizon_slope(13, 2, right, least_slope), 8 / 4.0, 1e-9);
  field.x = WrapMode::mirror;
  EXPECT_NEAR(HeightRays(field).horizon_slope(13, 2, right, least_slope), 8 / 17.0,
              1e-9);  // 15, 16 = 15, .. 30 = 1
  field.x = WrapMode::none;
  EXPECT_EQ(HeightRays(field).horizon_slope(13, 2, right, least_slope), least_slope);
}

TEST(HeightShadows, BeyondTheLastBorderTheWayEnds) {
  HeightField field = field_of(3, 2, [](int x, int) { return x == 1 ? 1e9F : 0.0F; });
  field.x = field.y = WrapMode::none;
  const HeightRays rays(field);
  const double floor = 1e-9;  // 1e18 texels until the ray is above the highest
  for (const Vec2& outward : {Vec2(-1, 0), Vec2(-0.8F, 0.6F), Vec2(-0.6F, -0.8F)})
    EXPECT_EQ(rays.horizon_slope(0, 0, outward, floor), floor);
  EXPECT_EQ(rays.horizon_slope(0, 0, {1, 0}, floor), 1e9);
  for (const WrapMode beyond : {WrapMode::wrap, WrapMode::mirror}) {
    field.y = beyond;
    for (const Vec2& along : {Vec2(0, 1), Vec2(-0.6F, -0.8F)})
      EXPECT_EQ(rays.horizon_slope(0, 0, along, floor), floor);
  }
}

TEST(HeightShadows, FlatAndTiltedGroundSeesEveryLightAboveIt) {
  const HeightField flat = field_of(8, 8, [](int, int) { return 3; });
  for (const FloatImage image = height_shadows(flat, light_from(12, 0.5)); const float value : image.data())
    EXPECT_EQ(value, 1);
  HeightField tilted = field_of(8, 8, [](int x, int) { return 0.5 * x; });
  tilted.x = WrapMode::none;
  EXPECT_EQ(height_shadows(tilted, light_from(0, 26)).texel(3, 3)[0], 0);  // atan 0.5 is 26.57 degrees
  EXPECT_EQ(height_shadows(tilted, light_from(0, 27)).texel(3, 3)[0], 1);
  EXPECT_EQ(height_shadows(flat, {0, 0, 1}).texel(3, 3)[0], 1);
  EXPECT_EQ(height_shadows(flat, light_from(0, -5)).texel(3, 3)[0], 0);
}

TEST(HeightShadows, ADiscOfLightHasAPenumbra) {
  HeightField field = field_of(128, 4, [](int x, int) { return x >= 100 ? 20 : 0; });
  field.x = WrapMode::none;
  const FloatImage seen = height_shadows(field, light_from(0, 30), 4 * pi / 180);
  for (int x = 1; x < 100; ++x) EXPECT_LE(seen.texel(x, 1)[0], seen.texel(x - 1, 1)[0]);
  for (int x = 0; x < 100; ++x) {
    const double horizon = std::atan(20.0 / (100 - x)) * 180 / pi;
    if (horizon < 26) {
      EXPECT_EQ(seen.texel(x, 1)[0], 1) << x;
    }
    if (horizon > 34) {
      EXPECT_EQ(seen.texel(x, 1)[0], 0) << x;
    }
    if (std::abs(horizon - 30) < 0.3) {
      // The strip between horizon and middle, over a disc of radius 2; of its 64 lights up to half a row of
      // 2 sqrt(64 / pi) more or less.
      EXPECT_NEAR(seen.texel(x, 1)[0], 0.5 + (30 - horizon) * 2 * 2 / (pi * 2 * 2), std::sqrt(64 / pi) / 64)
          << x;
    }
  }
}

}  // namespace
}  // namespace rnmbake
