#include "ssbump/normal_shadows/normal_shadows.h"

#include "ssbump/nms_support.h"

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// A roof along the columns, its ridge in the middle of the map: `rise` for each texel, `run` texels a side.
HeightField roof(int width, double rise, int run) {
  return field_of(width, 4,
                  [&](int x, int) { return std::max(0.0, rise * (run - std::abs(x - width / 2))); });
}

int shadowed_left_of(const FloatImage& left, int column) {
  int count = 0;
  for (int x = 0; x < column; ++x) count += left.texel(x, 1)[0] == 0 ? 1 : 0;
  return count;
}

TEST(NormalShadows, AFlatMapHasNone) {
  const FloatImage normals = even_normals(16, 16, {0, 0, 1});
  for (const double elevation : {1.0, 20.0, 60.0, 90.0}) {
    for (const bool hard : {false, true}) {
      for (const FloatImage image = normal_shadows(normals, light_from(40, elevation), {.hard = hard});
           const float value : image.data())
        EXPECT_EQ(value, 1) << elevation;
    }
  }
}

TEST(NormalShadows, APlaneThatFacesTheLightHasNoneHoweverItTilts) {
  for (const FloatImage image =
           normal_shadows(even_normals(16, 8, {-0.7F, 0.2F, 1}), light_from(180, 30), {});
       const float value : image.data())
    EXPECT_EQ(value, 1);
}

TEST(NormalShadows, WhereTheNormalFacesAwayThereIsNothingToShadow) {
  const FloatImage normals = even_normals(8, 8, {-1, 0, 0.2F});
  const Vec3 light = light_from(0, 20);
  const FloatImage left = normal_shadows(normals, light, {.hard = true});
  EXPECT_EQ(left.texel(3, 3)[0], 1);
  EXPECT_EQ(lit_by(normals, light, left).texel(3, 3)[0], 0);
}

/// Light from the right over a roof: on flat ground left of it the true shadow ends run (rise / tan e - 1)
/// texels from the foot. What the published sum makes of a slope is shorter by the normal's z.
TEST(NormalShadows, ARoofCastsAShadowOfKnownLength) {
  constexpr int width = 512, run = 24, foot = width / 2 - run;
  for (const double rise : {0.7, 1.5, 3.0}) {
    for (const double elevation : {20.0, 30.0}) {
      const FloatImage normals = normals_of_field(roof(width, rise, run));
      const Vec3 light = light_from(0, elevation);
      const double length = run * (rise / std::tan(elevation * pi / 180) - 1);
      // Lookups half a texel apart. The sum may miss half a step of the slope at the foot and at the ridge,
      // and begins one step into the light; either moves the shadow's end by what light rises meanwhile.
      NormalShadowOptions options{.length = 0.5F, .steps = int(512 * light.x), .hard = true};
      options.border = Border::clamp;
      const double step = 0.5 * width * light.x / options.steps;
      const double near_enough = 1 + step * (1 + rise / std::tan(elevation * pi / 180));
      const FloatImage published = normal_shadows(normals, light, options);
      EXPECT_NEAR(shadowed_left_of(published, foot), length / std::hypot(rise, 1), near_enough)
          << rise << ", " << elevation;
      options.true_slopes = true;
      EXPECT_NEAR(shadowed_left_of(normal_shadows(normals, light, options), foot), length, near_enough)
          << rise << ", " << elevation;
    }
  }
}

TEST(NormalShadows, NothingIsCastFartherThanTheLength) {
  const FloatImage normals = normals_of_field(roof(512, 3, 24));
  const Vec3 light = light_from(0, 10);
  const FloatImage left = normal_shadows(normals, light, {.length = 0.05F, .hard = true});
  const int foot = 256 - 24, reach = static_cast<int>(0.05F * 512 * light.x);
  for (int x = 0; x < foot - reach - 2; ++x) EXPECT_EQ(left.texel(x, 0)[0], 1) << x;
}

TEST(NormalShadows, BeyondTheBorderTheMapGoesOnOrItsLastTexelDoes) {
  FloatImage normals =
      normals_of_field(field_of(128, 4, [](int x, int) { return std::max(0, 8 - std::abs(x - 110)); }));
  NormalShadowOptions options{.length = 0.5F, .steps = 64, .hard = true};
  const Vec3 light = light_from(180, 10);  // the roof's shadow falls to the right, over the border
  const FloatImage tiled = normal_shadows(normals, light, options);
  options.border = Border::clamp;
  const FloatImage clamped = normal_shadows(normals, light, options);
  EXPECT_EQ(tiled.texel(4, 2)[0], 0);
  EXPECT_EQ(clamped.texel(4, 2)[0], 1);
  for (int x = 119; x < 128; ++x) EXPECT_EQ(tiled.texel(x, 2)[0], clamped.texel(x, 2)[0]) << x;
}

/// A map that is moved has its shadows moved with it: there is no seam.
TEST(NormalShadows, TiledMapsHaveNoSeam) {
  constexpr int side = 48;
  const FloatImage normals = normals_of_field(waves(side, side));
  FloatImage moved(side, side, 3);
  const auto from = [](int at) { return (at + 19) % side; };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      std::ranges::copy(normals.texel(from(x), from(y)), moved.texel(x, y).begin());
  const FloatImage left = normal_shadows(normals, light_from(200, 25), {}),
                   moved_left = normal_shadows(moved, light_from(200, 25), {});
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) EXPECT_EQ(moved_left.texel(x, y)[0], left.texel(from(x), from(y))[0]);
}

TEST(NormalShadows, AMirroredMapUnderAMirroredLightIsMirrored) {
  constexpr int width = 64, height = 40;
  const HeightField field = waves(width, height);
  const HeightField mirrored =
      field_of(width, height, [&](int x, int y) { return field.heights.texel(width - 1 - x, y)[0]; });
  for (const double azimuth : {30.0, 75.0, 200.0}) {
    const FloatImage one = normal_shadows(normals_of_field(field), light_from(azimuth, 20), {});
    const FloatImage other = normal_shadows(normals_of_field(mirrored), light_from(180 - azimuth, 20), {});
    int differ = 0;  // rounding may tip a sum that is just about as high as an earlier one
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        differ += std::abs(one.texel(x, y)[0] - other.texel(width - 1 - x, y)[0]) > 1e-5F ? 1 : 0;
    EXPECT_LE(differ, width * height / 1000) << azimuth;
  }
}

/// The published lines as they stand, with lookups by UV.
float as_published(const FloatImage& normals, int x, int y, const Vec3& l, float length, int steps) {
  const auto n_at = [&](const Vec2& uv) {
    std::array<float, 3> n{};
    sample(normals, bilinear_taps(normals, uv, Border::wrap), n);
    return Vec3(n[0], n[1], n[2]);
  };
  const Vec2 uv = texel_uv(normals, x, y);
  const float lit = std::max(0.0F, l.dot(n_at(uv)));
  if (lit <= 0) return 1;
  float slope = -lit, steepest = 0, shadow = 0;
  for (int i = 1; i <= steps; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(steps);
    slope -= l.dot(n_at(uv + Vec2(l.x, l.y) * length * t));
    if (slope > steepest) {
      shadow += 50 * length * (1 - t);
      steepest = slope;
    }
  }
  return std::clamp(1 - shadow / static_cast<float>(steps), 0.0F, 1.0F);
}

TEST(NormalShadows, DoesWhatThePublishedLinesDo) {
  constexpr int side = 64;
  const FloatImage normals = normals_of_field(waves(side, side));
  const Vec3 light = light_from(128, 18);
  const FloatImage left = normal_shadows(normals, light, {});
  int differ = 0, shadowed = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const float wanted = as_published(normals, x, y, light, 0.22F, 32);
      differ += std::abs(left.texel(x, y)[0] - wanted) > 1e-5F ? 1 : 0;
      shadowed += wanted < 1 ? 1 : 0;
    }
  }
  EXPECT_GT(shadowed, side * side / 20);
  EXPECT_LE(differ, side * side / 200);  // UVs are rounded to 1/1000 of a texel
}

TEST(NormalShadows, HardIsWhatSoftWouldDarkenAtAll) {
  const FloatImage normals = normals_of_field(waves(64, 64));
  const Vec3 light = light_from(10, 20);
  const FloatImage soft = normal_shadows(normals, light, {}),
                   hard = normal_shadows(normals, light, {.hard = true});
  for (std::size_t i = 0; i < soft.texels(); ++i)
    if (soft.data()[i] < 1) {
      EXPECT_EQ(hard.data()[i], 0);
    }
  for (const FloatImage image = normal_shadows(normals, light, {.hardness = 0.0F});
       const float value : image.data())
    EXPECT_EQ(value, 1);
}

TEST(NormalShadows, JitterIsTheSameEachTimeAndDiffersByItsSeed) {
  const FloatImage normals = normals_of_field(waves(64, 64));
  const Vec3 light = light_from(10, 20);
  const auto with_seed = [&](std::uint32_t seed) {
    return normal_shadows(normals, light, {.jitter = seed}).data();
  };
  EXPECT_EQ(with_seed(7), with_seed(7));
  EXPECT_NE(with_seed(7), with_seed(8));
  EXPECT_NE(with_seed(7), normal_shadows(normals, light, {}).data());
}

/// Texels are square: a map twice as wide, of the same texels, has the same shadows at half the length.
TEST(NormalShadows, LengthIsAShareOfTheLongerSide) {
  const HeightField field = waves(32, 32);
  const FloatImage one = normals_of_field(field);
  const FloatImage two =
      normals_of_field(field_of(64, 32, [&](int x, int y) { return field.heights.texel(x % 32, y)[0]; }));
  const Vec3 light = light_from(60, 20);
  const NormalShadowOptions half{.length = 0.125F, .hardness = 10.0F};
  const FloatImage left = normal_shadows(one, light, {.length = 0.25F, .hardness = 10.0F}),
                   wide = normal_shadows(two, light, half);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) EXPECT_EQ(wide.texel(x, y)[0], left.texel(x % 32, y)[0]);
}

}  // namespace
}  // namespace rnmbake
