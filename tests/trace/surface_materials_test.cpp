#include "trace/geometry/surface_materials.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Texel (x, y) holds (x, y, 1), row 0 on top.
Texture numbered(int width, int height) {
  Texture picture{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      picture.texels.emplace_back(static_cast<float>(x), static_cast<float>(y), 1.0F);
  }
  return picture;
}

TEST(LooksTest, TexelCentresAreExactAndPlacesBetweenAreMixed) {
  const Texture picture = numbered(4, 2);
  EXPECT_EQ(lookup(picture, {0.125F, 0.75F}), Vec3(0, 0, 1));
  EXPECT_EQ(lookup(picture, {0.875F, 0.25F}), Vec3(3, 1, 1)) << "v runs up";
  EXPECT_EQ(lookup(picture, {0.5F, 0.5F}), Vec3(1.5F, 0.5F, 1));
}

TEST(LooksTest, BordersAreClamped) {
  const Texture picture = numbered(4, 2);
  EXPECT_EQ(lookup(picture, {0, 1}), Vec3(0, 0, 1));
  EXPECT_EQ(lookup(picture, {1, 0}), Vec3(3, 1, 1));
  EXPECT_EQ(lookup(picture, {-7, 9}), Vec3(0, 0, 1));
  EXPECT_EQ(lookup(picture, {1e30F, -1e30F}), Vec3(3, 1, 1));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isfinite(lookup(picture, {nan, nan}).x));
  EXPECT_EQ(lookup(numbered(1, 1), {0.3F, 0.9F}), Vec3(0, 0, 1));
}

TEST(LooksTest, AlbedoStaysBetweenZeroAndOneEmissionDoesNot) {
  DiffuseScene scene;
  scene.pictures.push_back({1, 1, {Vec3(-1, 0.5F, 7)}});
  SurfaceMaterial material;
  material.albedo_picture = material.emission_picture = 0;
  scene.materials = {material, SurfaceMaterial{}};
  const SurfaceMaterials materials(scene);
  EXPECT_EQ(materials.albedo(0, {0, 0}), Vec3(0, 0.5F, 1));
  EXPECT_EQ(materials.emission(0, {0, 0}), Vec3(-1, 0.5F, 7));
  EXPECT_TRUE(materials.emits(0));
  EXPECT_FALSE(materials.emits(1));
}

}  // namespace
}  // namespace rnmbake
