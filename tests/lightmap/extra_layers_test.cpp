#include "lightmap/extra_layers.h"

#include "lightmap/half_range.h"
#include "support/pictures.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// The left half is covered and has `value`.
FloatImage left_half(int channels, float value) {
  FloatImage image(4, 4, channels);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 2; ++x) {
      for (float& v : image.texel(x, y)) v = value;
    }
  }
  return image;
}

LayeredImage merged() {
  LayeredImage image;
  image.layers.push_back({"", {"R", "G", "B"}, filled(4, 4, 3, 1)});
  image.layers.push_back({"coverage", {""}, left_half(1, 1)});
  return image;
}

ExtraLayers extra() {
  ExtraLayers layers;
  layers.standard_errors.push_back({"flat", left_half(3, 1e6F)});
  layers.validity = left_half(1, 0.75F);
  layers.sh.push_back(left_half(3, 2));
  layers.sh.push_back(left_half(3, -1e6F));
  return layers;
}

std::vector<std::string> names_of(const LayeredImage& image) {
  std::vector<std::string> names;
  for (const Layer& layer : image.layers) names.push_back(layer.name);
  return names;
}

TEST(ExtraLayers, StandBeforeTheCoverage) {
  LayeredImage image = merged();
  add_extra_layers(extra(), {}, image);
  EXPECT_EQ(names_of(image),
            (std::vector<std::string>{"", "flat_stderr", "sh0", "sh1", "validity", "coverage"}));
  EXPECT_EQ(image.find("validity")->channels, std::vector<std::string>{""});
}

TEST(ExtraLayers, FitIntoHalfFloats) {
  LayeredImage half = merged(), full = merged();
  MergeOptions options;
  add_extra_layers(extra(), options, half);
  EXPECT_EQ(half.find("flat_stderr")->pixels.texel(0, 0)[0], largest_half);
  EXPECT_EQ(half.find("sh1")->pixels.texel(0, 0)[2], -largest_half);
  options.depth = Depth::full;
  add_extra_layers(extra(), options, full);
  EXPECT_EQ(full.find("flat_stderr")->pixels.texel(0, 0)[0], 1e6F);
}

TEST(ExtraLayers, OnlyHarmonicsAreDilated) {
  LayeredImage image = merged();
  MergeOptions options;
  options.dilate = 1;
  add_extra_layers(extra(), options, image);
  EXPECT_EQ(image.find("sh0")->pixels.texel(2, 1)[0], 2);
  EXPECT_EQ(image.find("sh0")->pixels.texel(3, 1)[0], 0);
  EXPECT_EQ(image.find("flat_stderr")->pixels.texel(2, 1)[0], 0);
  EXPECT_EQ(image.find("validity")->pixels.texel(2, 1)[0], 0);
}

TEST(ExtraLayers, ScaledMapsHaveNoStandardErrors) {
  LayeredImage image = merged();
  MergeOptions options;
  options.normalize = Normalize::flat;
  add_extra_layers(extra(), options, image);
  EXPECT_EQ(image.find("flat_stderr"), nullptr);
  EXPECT_NE(image.find("sh0"), nullptr);
}

TEST(ExtraLayers, NothingIsAddedWhereThereIsNothing) {
  LayeredImage image = merged();
  EXPECT_TRUE(ExtraLayers{}.empty());
  add_extra_layers({}, {}, image);
  EXPECT_EQ(image.layers.size(), 2U);
}

}  // namespace
}  // namespace rnmbake
