#include "ssbump/normal_shadows/lightmap_shadows.h"

#include "encoding/dominant_direction.h"
#include "ssbump/nms_support.h"

#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

struct Sun {
  Vec3 towards;
  std::array<float, 3> colour{1, 1, 1};
};

/// What a bake under these suns and a uniform sky holds, every texel alike.
BakedLight baked(const std::vector<Sun>& suns, float sky, int width = 4, int height = 4) {
  const auto filled = [&](const Vec3& direction) {
    FloatImage map(width, height, 3);
    for (std::size_t i = 0; i < map.data().size(); ++i) {
      map.data()[i] = sky * (1 + direction.z) / 2;
      for (const Sun& sun : suns)
        map.data()[i] += sun.colour[i % 3] * std::max(0.0F, direction.dot(sun.towards));
    }
    return map;
  };
  const auto basis = rnm_basis();
  return {filled({0, 0, 1}), {filled(basis[0]), filled(basis[1]), filled(basis[2])}, {}};
}

TEST(DominantDirection, OfALoneSunIsTheSun) {
  const Vec3 sun = light_from(70, 60);
  const BakedLight light = baked({{sun, {2, 2, 2}}}, 0);
  const auto texel = [](const FloatImage& map) {
    return std::array{map.data()[0], map.data()[1], map.data()[2]};
  };
  const LinearLight fit =
      fit_linear(texel(light.flat), {texel(light.rnm[0]), texel(light.rnm[1]), texel(light.rnm[2])});
  EXPECT_NEAR(fit.ambient[0], 0, 1e-6);
  const auto direction = dominant_direction(fit);
  ASSERT_TRUE(direction);
  EXPECT_LT((*direction - sun).length(), 1e-6);
}

TEST(DominantDirection, NeverPointsBelowAndMayNotExist) {
  LinearLight light;
  EXPECT_FALSE(dominant_direction(light));
  light.ambient = {1, 1, 1};
  EXPECT_FALSE(dominant_direction(light));
  light.gradient.fill({0.5F, 0, -0.5F});
  EXPECT_EQ(dominant_direction(light), Vec3(1, 0, 0));
  light.gradient.fill({0, 0, -0.5F});
  EXPECT_FALSE(dominant_direction(light));
}

TEST(LightmapShadows, ALoneSunIsTheSameAsOneLight) {
  const FloatImage normals = normals_of_field(waves(48, 32, 4));
  for (const NormalShadowOptions& options :
       {NormalShadowOptions{}, NormalShadowOptions{.hard = true, .true_slopes = true}}) {
    const Vec3 sun = light_from(25, 58);
    const FloatImage lit = lit_by(normals, sun, normal_shadows(normals, sun, options));
    const FloatImage result = lightmap_shadows(normals, baked({{sun}}, 0), {}, options);
    ASSERT_EQ(result.width(), 48);
    int differ = 0;
    for (std::size_t i = 0; i < lit.texels(); ++i)
      differ += std::abs(result.data()[3 * i] - lit.data()[i]) > 1e-5F ? 1 : 0;
    EXPECT_LE(differ, 2);  // the fit's direction is the sun's but for rounding
  }
}

TEST(LightmapShadows, OfAUniformSkyNothingIsShadowed) {
  const FloatImage normals = normals_of_field(waves(32, 32, 4));
  const FloatImage result = lightmap_shadows(normals, baked({}, 1), {}, {});
  for (std::size_t i = 0; i < normals.texels(); ++i)
    EXPECT_NEAR(result.data()[3 * i + 1], (1 + normals.data()[3 * i + 2]) / 2, 1e-5);
}

/// Under sun and sky exactly the sun's part is missing where a hard shadow falls... as far as the fit tells
/// the two apart: a sky of 1 is half directional, straight up.
TEST(LightmapShadows, OnlyTheDirectionalPartIsShadowed) {
  const FloatImage normals = normals_of_field(waves(48, 48, 4));
  const Vec3 sun = light_from(200, 55);
  const BakedLight light = baked({{sun, {3, 3, 3}}}, 0.5F);
  const FloatImage all = lightmap_shadows(normals, light, {}, {.hardness = 0.0F});
  const FloatImage left = lightmap_shadows(normals, light, {}, {.length = 0.4F, .hard = true});
  int shadowed = 0;
  for (std::size_t i = 0; i < normals.texels(); ++i) {
    const float* n = &normals.data()[3 * i];
    const Vec3 normal(n[0], n[1], n[2]), gradient = sun * 3.0F + Vec3(0, 0, 0.25F);
    const float wanted = std::max(0.0F, 0.25F + gradient.dot(normal));
    EXPECT_NEAR(all.data()[3 * i], wanted, 1e-5);
    if (left.data()[3 * i] == all.data()[3 * i]) continue;
    EXPECT_NEAR(left.data()[3 * i], 0.25F, 1e-5);
    ++shadowed;
  }
  EXPECT_GT(shadowed, 20);
}

/// The cosine between the suns is 0.34, and what blue's gradient has of green's direction is 0.17 of green's.
TEST(LightmapShadows, AnotherColourLosesOnlyWhatItHasOfTheDirection) {
  const FloatImage normals = normals_of_field(waves(48, 48, 4));
  const Vec3 green = light_from(0, 55), blue = light_from(180, 55);
  const BakedLight light = baked({{green, {0, 1, 0}}, {blue, {0, 0, 0.5F}}}, 0);
  const FloatImage all = lightmap_shadows(normals, light, {}, {.hardness = 0.0F}),
                   left = lightmap_shadows(normals, light, {}, {.length = 0.4F, .hard = true});
  double green_lost = 0, blue_lost = 0;
  for (std::size_t i = 0; i < normals.texels(); ++i) {
    green_lost += all.data()[3 * i + 1] - left.data()[3 * i + 1];
    blue_lost += all.data()[3 * i + 2] - left.data()[3 * i + 2];
    EXPECT_EQ(left.data()[3 * i], 0);
  }
  EXPECT_GT(green_lost, 20);
  EXPECT_LT(blue_lost, 0.2 * green_lost);
}

TEST(LightmapShadows, YDownLightmapsAreTurned) {
  const FloatImage normals = normals_of_field(waves(32, 32, 4));
  const Vec3 sun = light_from(80, 58);
  BakedLight up = baked({{sun}}, 0.2F), down = baked({{Vec3(sun.x, -sun.y, sun.z)}}, 0.2F);
  down.y_down = true;
  const FloatImage a = lightmap_shadows(normals, up, {}, {.hardness = 0.0F}),
                   b = lightmap_shadows(normals, down, {}, {.hardness = 0.0F});
  for (std::size_t i = 0; i < a.data().size(); ++i) EXPECT_NEAR(a.data()[i], b.data()[i], 1e-5);
}

TEST(LightmapShadows, ARepeatedNormalMapCoversTheLightmapOnce) {
  const FloatImage normals = normals_of_field(waves(16, 24));
  BakedLight light = baked({{light_from(30, 60)}}, 0, 2, 1);
  for (FloatImage* map : {&light.flat, &light.rnm[0], &light.rnm[1], &light.rnm[2]})
    for (std::size_t c = 0; c < 3; ++c) map->data()[c] = 0;  // the left half is dark
  const FloatImage result = lightmap_shadows(normals, light, {3, 2}, {.hardness = 0.0F});
  EXPECT_EQ(result.width(), 48);
  EXPECT_EQ(result.height(), 48);
  EXPECT_EQ(result.texel(3, 40)[0], 0);
  EXPECT_GT(result.texel(44, 40)[0], 0.1F);
  for (int y = 0; y < 24; ++y) EXPECT_NEAR(result.texel(44, y)[0], result.texel(44, y + 24)[0], 1e-5);
}

TEST(LightmapShadows, UncoveredTexelsStayOut) {
  const FloatImage normals = even_normals(8, 8, {0, 0, 1});
  BakedLight light = baked({{light_from(0, 60)}}, 0, 2, 1);
  light.coverage = FloatImage(2, 1, 1);
  light.coverage.data() = {1, 0};
  for (std::size_t c = 3; c < 6; ++c) light.flat.data()[c] = 100;
  const FloatImage result = lightmap_shadows(normals, light, {}, {});
  EXPECT_NEAR(result.texel(4, 4)[0], std::sin(60 * pi / 180), 1e-5);
}

}  // namespace
}  // namespace rnmbake
