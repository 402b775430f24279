#include "lightmap/decode.h"

#include "base/error.h"
#include "encoding/encodings.h"
#include "encoding/rnm.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

FloatImage of_colour(int width, int height, const Vec3& colour) {
  FloatImage image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      std::ranges::copy(std::array{colour.x, colour.y, colour.z}, image.texel(x, y).begin());
  return image;
}

Lightmap lightmap(const std::array<Vec3, 3>& maps, const Vec3& flat, int width = 4, int height = 2) {
  Lightmap result;
  result.metadata.bases = rnm_set().directions;
  result.metadata.bases.push_back(flat_direction());
  result.layers["flat"] = of_colour(width, height, flat);
  for (std::size_t i = 0; i < 3; ++i)
    result.layers[std::string(rnm_layers[i])] = of_colour(width, height, maps[i]);
  return result;
}

Lightmap uniform_sky() {
  const float value = (1 + rnm_basis()[0].z) / 2;
  return lightmap({Vec3(value), Vec3(value), Vec3(value)}, Vec3(1));
}

Lightmap coloured() {
  return lightmap({Vec3(1, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 3)}, Vec3(0.4F, 0.5F, 0.6F));
}

Vec3 first_texel(const FloatImage& image) {
  const auto t = image.texel(0, 0);
  return {t[0], t[1], t[2]};
}

Vec3 lit(const Lightmap& map, const Vec3& normal, DecodeVariant variant, Green green = Green::y_up) {
  return first_texel(decode(map, normal, green, variant));
}

void expect_near(const Vec3& a, const Vec3& b) {
  EXPECT_NEAR(a.x, b.x, 1e-5);
  EXPECT_NEAR(a.y, b.y, 1e-5);
  EXPECT_NEAR(a.z, b.z, 1e-5);
}

LayeredImage picture(std::vector<std::string> channels, std::vector<float> texel) {
  LayeredImage image;
  image.layers.push_back({"", std::move(channels), FloatImage(1, 1, static_cast<int>(texel.size()))});
  image.layers[0].pixels.data() = std::move(texel);
  return image;
}

TEST(Decode, UniformSky) {
  EXPECT_NEAR(lit(uniform_sky(), {0, 0, 1}, DecodeVariant::squared).x, 0.788675, 1e-6);
  EXPECT_NEAR(lit(uniform_sky(), {0, 0, 1}, DecodeVariant::vrad).x, 1, 1e-6);
  EXPECT_NEAR(lit(uniform_sky(), {0, 0, 1}, DecodeVariant::single).x, 1, 1e-6);
  EXPECT_NEAR(lit(uniform_sky(), {0, 0, 1}, DecodeVariant::linear).x, 1.366025, 1e-5);
}

TEST(Decode, OverheadSun) {
  const float cosine = rnm_basis()[0].z;
  const Lightmap sun = lightmap({Vec3(cosine), Vec3(cosine), Vec3(cosine)}, Vec3(1));
  EXPECT_NEAR(lit(sun, {0, 0, 1}, DecodeVariant::squared).x, 0.577350, 1e-6);
  EXPECT_NEAR(lit(sun, {0, 0, 1}, DecodeVariant::vrad).x, 1, 1e-6);
  EXPECT_NEAR(lit(sun, {0, 0, 1}, DecodeVariant::linear).x, 1, 1e-6);
}

TEST(Decode, NormalOnABasisVectorReturnsItsMap) {
  expect_near(lit(coloured(), rnm_basis()[0], DecodeVariant::squared), {1, 0, 0});
  expect_near(lit(coloured(), rnm_basis()[1], DecodeVariant::squared), {0, 2, 0});
  expect_near(lit(coloured(), rnm_basis()[2], DecodeVariant::squared), {0, 0, 3});
}

TEST(Decode, HalfWayBetweenTwoBasisVectors) {
  const Vec3 normal = rnm_basis()[0] + rnm_basis()[1];  // not of unit length: decode sees to that
  expect_near(lit(coloured(), normal, DecodeVariant::squared), {0.5F, 1, 0});
  expect_near(lit(coloured(), normal, DecodeVariant::linear), {0.7071068F, 1.4142136F, 0});
}

TEST(Decode, VradReturnsTheFlatBakeForAFlatNormal) {
  expect_near(lit(coloured(), {0, 0, 1}, DecodeVariant::vrad), {0.4F, 0.5F, 0.6F});
}

TEST(Decode, NormalizedMapsAreNotScaledAgain) {
  Lightmap map = coloured();
  map.metadata.normalize =
      Normalize::flat;  // the header says so; its maps' mean is not flat, so scaling would show
  expect_near(lit(map, {0, 0, 1}, DecodeVariant::vrad), {1 / 3.0F, 2 / 3.0F, 1});
}

TEST(Decode, GreenIsTurnedToTheLightmaps) {
  Lightmap map = coloured();
  expect_near(lit(map, rnm_basis()[1], DecodeVariant::squared, Green::y_down), {0, 0, 3});
  map.metadata.green = Green::y_down;
  expect_near(lit(map, rnm_basis()[1], DecodeVariant::squared, Green::y_down), {0, 2, 0});
  expect_near(lit(map, rnm_basis()[1], DecodeVariant::squared, Green::y_up), {0, 0, 3});
}

TEST(Decode, OutputHasTheNormalMapsSizeAndSharesTheUvs) {
  Lightmap map = coloured();
  for (int y = 0; y < 2; ++y)
    std::ranges::fill(map.layers["rnm0"].texel(3, y), 9.0F);  // the right-hand column
  NormalPicture normals{of_colour(8, 8, Vec3(0, 0, 1)), Green::y_up};
  const Vec3 b0 = rnm_basis()[0];
  std::ranges::copy(std::array{b0.x, b0.y, b0.z}, normals.normals.texel(7, 0).begin());
  const FloatImage result = decode(map, normals, DecodeVariant::squared);
  EXPECT_EQ(result.width(), 8);
  EXPECT_EQ(result.height(), 8);
  EXPECT_NEAR(result.texel(7, 0)[1], 9, 1e-5);
  EXPECT_NEAR(result.texel(0, 7)[0], 1 / 3.0, 1e-5);
  EXPECT_NEAR(result.texel(6, 5)[1], (0.75 * 9 + 2) / 3,
              1e-4);  // a quarter of a texel left of the last centre
}

TEST(Decode, UncoveredTexelsStayOutOfTheLookup) {
  Lightmap map = uniform_sky();
  map.coverage = FloatImage(4, 2, 1);
  for (int x = 0; x < 2; ++x)
    for (int y = 0; y < 2; ++y) map.coverage.texel(x, y)[0] = 1;
  for (const char* name : {"rnm0", "rnm1", "rnm2"})
    for (int y = 0; y < 2; ++y)
      std::ranges::fill(map.layers[name].texel(2, y), std::numeric_limits<float>::quiet_NaN());
  const FloatImage result =
      decode(map, {of_colour(16, 8, Vec3(0, 0, 1)), Green::y_up}, DecodeVariant::squared);
  EXPECT_NEAR(result.texel(7, 4)[0], 0.788675, 1e-6);
}

TEST(Decode, MissingLayersAreNamed) {
  Lightmap map = coloured();
  map.layers.erase("flat");
  EXPECT_THROW((void)lit(map, {0, 0, 1}, DecodeVariant::single), Error);
  EXPECT_THROW((void)lit(map, {0, 0, 1}, DecodeVariant::vrad), Error);
  expect_near(lit(map, {0, 0, 1}, DecodeVariant::squared), {1 / 3.0F, 2 / 3.0F, 1});
  map = coloured();
  map.layers.erase("rnm2");
  EXPECT_THROW((void)lit(map, {0, 0, 1}, DecodeVariant::squared), Error);
  expect_near(lit(map, {0, 0, 1}, DecodeVariant::single), {0.4F, 0.5F, 0.6F});
}

TEST(Decode, ObstaclesAreFound) {
  const LightmapMetadata good = coloured().metadata;
  for (const auto variant :
       {DecodeVariant::squared, DecodeVariant::linear, DecodeVariant::vrad, DecodeVariant::single})
    EXPECT_FALSE(decode_obstacle(good, variant).has_value());
  LightmapMetadata other = good;
  other.convention = "signed projection";
  EXPECT_TRUE(decode_obstacle(other, DecodeVariant::single).has_value());
  other = good;
  other.units = "E";
  EXPECT_TRUE(decode_obstacle(other, DecodeVariant::squared).has_value());
  other = good;
  other.bases[0].direction = Vec3(0.904534F, 0, 0.426401F);
  EXPECT_TRUE(decode_obstacle(other, DecodeVariant::squared).has_value());
  EXPECT_FALSE(decode_obstacle(other, DecodeVariant::single).has_value());
  other = good;
  other.normalize = Normalize::flat;
  EXPECT_TRUE(decode_obstacle(other, DecodeVariant::linear).has_value());
  EXPECT_FALSE(decode_obstacle(other, DecodeVariant::squared).has_value());
}

TEST(NormalsOf, EightBitPicturesAreUnpackedAndRenormalised) {
  expect_near(first_texel(normals_of(picture({"R", "G", "B"}, {0.5F, 0.5F, 1}), "n")), {0, 0, 1});
  const Vec3 raw(2 * 200 / 255.0F - 1, 2 * 30 / 255.0F - 1, 2 * 180 / 255.0F - 1);
  expect_near(first_texel(normals_of(
                  picture({"R", "G", "B", "A"}, {200 / 255.0F, 30 / 255.0F, 180 / 255.0F, 0}), "n")),
              raw.normalized());
}

TEST(NormalsOf, ChannelsCountByName) {
  expect_near(first_texel(normals_of(picture({"X", "Y", "Z", "A"}, {0.6F, 0, 0.8F, 1}), "n")),
              {0.6F, 0, 0.8F});
  expect_near(first_texel(normals_of(picture({"A", "X", "Y", "Z"}, {1, 0.6F, 0, 0.8F}), "n")),
              {0.6F, 0, 0.8F});
  expect_near(first_texel(normals_of(picture({"A", "B", "G", "R"}, {0, 0.9F, 0.5F, 0.8F}), "n")),
              {0.6F, 0, 0.8F});
  LayeredImage render = picture({"R", "G", "B"}, {0.5F, 0.5F, 0.5F});
  render.layers.push_back(picture({"X", "Y", "Z"}, {0.6F, 0, 0.8F}).layers[0]);
  render.layers[1].name = "View Layer.Normal";
  expect_near(first_texel(normals_of(render, "n")), {0.6F, 0, 0.8F});
  LayeredImage eyes = render;
  eyes.layers[0] = eyes.layers[1];
  eyes.layers[0].name = "left.Normal";
  try {
    (void)normals_of(eyes, "n.exr");
    FAIL() << "one of two was taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("left.Normal (X, Y, Z), View Layer.Normal (X, Y, Z)"),
              std::string::npos)
        << error.what();
  }
}

TEST(LightmapOf, AlphaThatAnotherProgramAddedIsLeftOut) {
  Lightmap map = lightmap_of(picture({"R", "G", "B", "A"}, {1, 2, 3, 0.5F}), {});
  ASSERT_TRUE(map.holds(flat_encoding));
  expect_near(first_texel(map.take("flat")), {1, 2, 3});
  EXPECT_TRUE(lightmap_of(picture({"X", "Y", "Z"}, {1, 2, 3}), {}).layers.empty());
}

TEST(NormalsOf, TwoChannelsSignedOnesAndNothing) {
  expect_near(first_texel(normals_of(picture({"R", "G"}, {0.8F, 0.5F}), "n")), {0.6F, 0, 0.8F});
  expect_near(first_texel(normals_of(picture({"X", "Y", "Z"}, {0.6F, 0, 0.8F}), "n")), {0.6F, 0, 0.8F});
  expect_near(first_texel(normals_of(picture({"R", "G", "B"}, {0, -0.6F, 0.8F}), "n")), {0, -0.6F, 0.8F});
  expect_near(first_texel(normals_of(picture({"R", "G", "B"}, {0.5F, 0.5F, 0.5F}), "n")), {0, 0, 1});
  EXPECT_THROW((void)normals_of(picture({"Y"}, {0.5F}), "n"), Error);
  EXPECT_THROW((void)normals_of(picture({"Y", "A"}, {0.5F, 1}), "n"), Error);
  EXPECT_THROW((void)normals_of(picture({"A", "Y"}, {1, 0.5F}), "n"), Error) << "as read_image() has it";
}

}  // namespace
}  // namespace rnmbake
