#include "ssbump/map/encode.h"

#include "encoding/rnm.h"
#include "ssbump/map/metadata.h"
#include "ssbump/map/weights.h"

#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

FloatImage some_weights(int width, int height) {
  FloatImage weights(width, height, SsbumpWeights::channels);
  std::mt19937 random(7);
  for (float& value : weights.data()) value = std::uniform_real_distribution<float>(0, 1)(random);
  return weights;
}

FloatImage open_weights() {
  FloatImage weights(4, 4, SsbumpWeights::channels);
  for (float& value : weights.data()) value = 1;
  return weights;
}

TEST(Encode, GivesTheFlatPatchItsValueAndTheSameEnergyUnderEachScale) {
  const std::array<float, 3> lightmaps{0.7F, 0.4F, 0.1F};  // scaled so that their mean is the flat bake
  const float flat_bake = 0.4F;
  for (const auto scale : {SsbumpScale::third, SsbumpScale::ndotb, SsbumpScale::mod2x}) {
    const SsbumpEncoding encoding{scale, Handed::right, SsbumpAlpha::none};
    const FloatImage stored = encode(open_weights(), encoding);
    const float expected = scale == SsbumpScale::third ? 1.0F / 3
                                                       : static_cast<float>(rnm_basis()[0].z) *
                                                             (scale == SsbumpScale::mod2x ? 0.5F : 1.0F);
    float light = 0;
    const FloatImage weights = decode_weights(stored, encoding);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_FLOAT_EQ(stored.texel(1, 2)[i], expected);
      light += weights.texel(1, 2)[i] * lightmaps[i] / 3;
    }
    EXPECT_NEAR(light, flat_bake, 1e-6);
  }
}

TEST(Encode, ComesBack) {
  const FloatImage weights = some_weights(5, 3);
  for (const auto scale : {SsbumpScale::third, SsbumpScale::ndotb, SsbumpScale::mod2x}) {
    for (const auto handed : {Handed::right, Handed::left}) {
      for (const auto alpha : {SsbumpAlpha::none, SsbumpAlpha::up, SsbumpAlpha::ao}) {
        const SsbumpEncoding encoding{scale, handed, alpha};
        const FloatImage back = decode_weights(encode(weights, encoding), encoding);
        for (std::size_t at = 0; at < back.data().size(); ++at) {
          const std::size_t c = at % SsbumpWeights::channels;
          const bool stored = c < 3 || (c == SsbumpWeights::up && alpha == SsbumpAlpha::up) ||
                              (c == SsbumpWeights::ambient && alpha == SsbumpAlpha::ao);
          EXPECT_NEAR(back.data()[at], stored ? weights.data()[at] : 1, 1e-6);
        }
      }
    }
  }
}

TEST(Encode, LeftHandedSwapsTheSecondAndThirdChannel) {
  const FloatImage weights = some_weights(2, 2);
  const FloatImage right = encode(weights, {SsbumpScale::third, Handed::right, SsbumpAlpha::none});
  const FloatImage left = encode(weights, {SsbumpScale::third, Handed::left, SsbumpAlpha::none});
  EXPECT_EQ(right.texel(1, 1)[0], left.texel(1, 1)[0]);
  EXPECT_EQ(right.texel(1, 1)[1], left.texel(1, 1)[2]);
  EXPECT_EQ(right.texel(1, 1)[2], left.texel(1, 1)[1]);
}

TEST(Dither, KeepsTheMeanAndWhatLiesOnAStep) {
  constexpr int side = 256;
  for (const float value : {0.3333F, 0.1F, 0.50123F}) {
    FloatImage image(side, side, 3);
    for (float& v : image.data()) v = value;
    dither(image, Storage::u8, 1, 0);
    double sum = 0;
    for (const float v : image.data()) {
      const float steps = 255 * v;
      EXPECT_NEAR(steps, std::round(steps), 1e-4);
      EXPECT_LT(std::abs(v - value), 1.0001 / 255);
      sum += v;
    }
    const double share = 255 * value - std::floor(255 * value);
    const double standard_error = std::sqrt(share * (1 - share) / (side * side * 3)) / 255;
    EXPECT_NEAR(sum / (side * side * 3), value, 4 * standard_error);
  }
  FloatImage flat = encode(open_weights(), {});
  dither(flat, Storage::u8, 3, 0);
  for (const float v : flat.data()) EXPECT_FLOAT_EQ(v, 85.0F / 255);
}

TEST(Dither, DependsOnThePlaceInThePictureAndNotOnTheRowsGiven) {
  FloatImage whole = encode(some_weights(9, 8), {}), lower(9, 3, 3);
  std::copy(whole.data().begin() + 9 * 5 * 3, whole.data().end(), lower.data().begin());
  dither(whole, Storage::u8, 5, 0);
  dither(lower, Storage::u8, 5, 5);
  for (int x = 0; x < 9; ++x)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(whole.texel(x, 6)[c], lower.texel(x, 1)[c]);
}

TEST(SsbumpMetadata, ComesBackFromEitherKindOfAttribute) {
  SsbumpMetadata metadata;
  metadata.scale = SsbumpScale::mod2x;
  metadata.handed = Handed::left;
  metadata.alpha = SsbumpAlpha::up;
  metadata.power = 2.5;
  metadata.method = "horizon";
  metadata.settings = "height 32 texels, filter 10";
  const auto all = attributes_of(metadata);
  const std::map<std::string, Attribute> description{{"ImageDescription", all.at("ImageDescription")}};
  std::string broken = std::get<std::string>(all.at("ImageDescription"));
  for (std::size_t at = 80; at < broken.size(); at += 81) broken.insert(at, 1, '\n');  // as TGA does
  const std::map<std::string, Attribute> lines{{"ImageDescription", Attribute(broken)}};
  auto parts = all;
  parts.erase("ImageDescription");
  for (const auto& attributes : {all, description, lines, parts}) {
    const auto back = ssbump_metadata(attributes, "x.png");
    ASSERT_TRUE(back);
    EXPECT_EQ(back->scale, metadata.scale);
    EXPECT_EQ(back->handed, metadata.handed);
    EXPECT_EQ(back->alpha, metadata.alpha);
    EXPECT_EQ(back->power, metadata.power);
    EXPECT_EQ(back->method, metadata.method);
    EXPECT_EQ(back->settings, metadata.settings);
  }
  EXPECT_FALSE(ssbump_metadata({{"ImageDescription", Attribute(std::string("a holiday; scale=big"))}}, "x"));
}

}  // namespace
}  // namespace rnmbake
