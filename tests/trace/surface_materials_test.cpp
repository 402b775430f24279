#include "trace/geometry/surface_materials.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Texel (x, y) holds (x, y, 1), row 0 on top.
Picture numbered(int width, int height) {
  Picture picture{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      picture.texels.emplace_back(static_cast<float>(x), static_cast<float>(y), 1.0F);
  }
  return picture;
}

TEST(LooksTest, TexelCentresAreExactAndPlacesBetweenAreMixed) {
  const Picture picture = numbered(4, 2);
  EXPECT_EQ(look_up(picture, {0.125F, 0.75F}), Vec3(0, 0, 1));
  EXPECT_EQ(look_up(picture, {0.875F, 0.25F}), Vec3(3, 1, 1)) << "v runs up";
  EXPECT_EQ(look_up(picture, {0.5F, 0.5F}), Vec3(1.5F, 0.5F, 1));
}

TEST(LooksTest, BordersAreClamped) {
  const Picture picture = numbered(4, 2);
  EXPECT_EQ(look_up(picture, {0, 1}), Vec3(0, 0, 1));
  EXPECT_EQ(look_up(picture, {1, 0}), Vec3(3, 1, 1));
  EXPECT_EQ(look_up(picture, {-7, 9}), Vec3(0, 0, 1));
  EXPECT_EQ(look_up(picture, {1e30F, -1e30F}), Vec3(3, 1, 1));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isfinite(look_up(picture, {nan, nan}).x));
  EXPECT_EQ(look_up(numbered(1, 1), {0.3F, 0.9F}), Vec3(0, 0, 1));
}

TEST(LooksTest, AlbedoStaysBetweenZeroAndOneEmissionDoesNot) {
  Exchange scene;
  scene.pictures.push_back({1, 1, {Vec3(-1, 0.5F, 7)}});
  Look look;
  look.albedo_picture = look.emission_picture = 0;
  scene.looks = {look, Look{}};
  const Looks looks(scene);
  EXPECT_EQ(looks.albedo(0, {0, 0}), Vec3(0, 0.5F, 1));
  EXPECT_EQ(looks.emission(0, {0, 0}), Vec3(-1, 0.5F, 7));
  EXPECT_TRUE(looks.emits(0));
  EXPECT_FALSE(looks.emits(1));
}

}  // namespace
}  // namespace rnmbake
