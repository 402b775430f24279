#include "ssbump/map/normal_map.h"

#include "base/error.h"
#include "ssbump/nms_support.h"
#include "ssbump/normal_shadows/normal_shadows.h"

#include <limits>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// As a picture stores them, (n + 1) / 2, in so many channels.
LayeredImage packed(const FloatImage& normals, std::vector<std::string> channels) {
  LayeredImage picture{{{"", channels, FloatImage(normals.width(), normals.height(), int(channels.size()))}},
                       {}};
  FloatImage& pixels = picture.layers[0].pixels;
  for (int y = 0; y < pixels.height(); ++y)
    for (int x = 0; x < pixels.width(); ++x)
      for (std::size_t c = 0; c < std::min<std::size_t>(3, channels.size()); ++c)
        pixels.texel(x, y)[c] = (normals.texel(x, y)[c] + 1) / 2;
  return picture;
}

void expect_near(const FloatImage& a, const FloatImage& b, float bound) {
  ASSERT_EQ(a.data().size(), b.data().size());
  for (std::size_t i = 0; i < a.data().size(); ++i) ASSERT_NEAR(a.data()[i], b.data()[i], bound) << i;
}

std::string refused(const LayeredImage& picture) {
  try {
    (void)unit_normals(picture, "n.png", {});
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    return error.what();
  }
  return "";
}

const FloatImage surface_normals = normals_of_field(waves(32, 32));

TEST(NormalMap, TwoChannelsAreAsGoodAsThree) {
  const FloatImage three = unit_normals(packed(surface_normals, {"R", "G", "B"}), "n.png", {});
  const FloatImage two = unit_normals(packed(surface_normals, {"R", "G"}), "n.png", {});
  const FloatImage grey_alpha =
      unit_normals(packed(surface_normals, {"Y", "A"}), "n.png", {.two_channel = true});
  LayeredImage other_blue = packed(surface_normals, {"R", "G", "B", "A"});
  for (std::size_t i = 2; i < other_blue.layers[0].pixels.data().size(); i += 4)
    other_blue.layers[0].pixels.data()[i] = 0.123F;
  const FloatImage first_two = unit_normals(other_blue, "n.png", {.two_channel = true});
  for (const FloatImage& same : {two, grey_alpha, first_two}) expect_near(same, three, 1e-5F);
  const Vec3 light = light_from(70, 20);
  int differ = 0;  // rounding may tip a sum that is just about 0
  const FloatImage a = normal_shadows(three, light, {}), b = normal_shadows(two, light, {});
  for (std::size_t i = 0; i < a.texels(); ++i) differ += std::abs(a.data()[i] - b.data()[i]) > 1e-4F ? 1 : 0;
  EXPECT_LE(differ, 1);
}

TEST(NormalMap, VectorsAndLengths) {
  LayeredImage vectors{{{"", {"X", "Y", "Z"}, surface_normals}}, {}};
  for (float& value : vectors.layers[0].pixels.data()) value *= 3;
  expect_near(unit_normals(vectors, "n.exr", {}), surface_normals, 1e-6F);
  vectors.layers[0].channels = {"R", "G", "B"};  // signed: something is below 0
  expect_near(unit_normals(vectors, "n.exr", {}), surface_normals, 1e-6F);
}

TEST(NormalMap, GreenDownIsTurned) {
  FloatImage down = surface_normals;
  for (std::size_t i = 1; i < down.data().size(); i += 3) down.data()[i] *= -1;
  expect_near(unit_normals(packed(down, {"R", "G", "B"}), "n.png", {.y_down = true}), surface_normals, 1e-5F);
}

TEST(NormalMap, WhatIsNoNormalMapIsRefused) {
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(refused(packed(surface_normals, {"Y"})), "n.png holds no normals"));
  EXPECT_TRUE(has(refused(packed(surface_normals, {"Y", "A"})), "n.png holds no normals"));
  LayeredImage nan = packed(surface_normals, {"R", "G", "B"});
  nan.layers[0].pixels.texel(3, 5)[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(has(refused(nan), "texel (3, 5) is not finite")) << refused(nan);
  LayeredImage zero = packed(surface_normals, {"R", "G", "B"});
  std::ranges::fill(zero.layers[0].pixels.texel(4, 6), 0.5F);
  EXPECT_TRUE(has(refused(zero), "texel (4, 6) is a normal of length 0.000")) << refused(zero);
  LayeredImage dark = packed(surface_normals, {"R", "G", "B"});
  for (float& value : dark.layers[0].pixels.data()) value *= 0.2F;
  EXPECT_TRUE(has(refused(dark), "point below the surface")) << refused(dark);
}

}  // namespace
}  // namespace rnmbake
