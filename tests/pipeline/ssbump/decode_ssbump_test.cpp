#include "pipeline/ssbump/decode_ssbump.h"

#include "base/error.h"
#include "base/files.h"
#include "encoding/basis_set.h"
#include "encoding/encodings.h"
#include "encoding/rnm.h"
#include "ssbump/generate/generate.h"
#include "ssbump/heights/height_shadows.h"
#include "ssbump/map/normals.h"
#include "ssbump/map/weights.h"
#include "support/pictures.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Light that comes from one side; maps are scaled so that their mean is the flat bake.
Lightmap sided() {
  Lightmap lightmap;
  lightmap.metadata.bases = rnm_set().directions;
  lightmap.metadata.normalize = Normalize::flat;
  lightmap.layers["flat"] = filled(2, 2, 3, 0.5F);
  lightmap.layers["rnm0"] = filled(2, 2, 3, 0.8F);
  lightmap.layers["rnm1"] = filled(2, 2, 3, 0.5F);
  lightmap.layers["rnm2"] = filled(2, 2, 3, 0.2F);
  return lightmap;
}

FloatImage some_weights() {
  FloatImage weights(6, 4, SsbumpWeights::channels);
  std::mt19937 random(4);
  for (float& value : weights.data()) value = std::uniform_real_distribution<float>(0, 1)(random);
  return weights;
}

class DecodeSsbump : public testing::Test {
 protected:
  /// Through a file, so that what it says of itself decides.
  SsbumpPicture stored(const FloatImage& weights, const SsbumpEncoding& encoding, const char* name) {
    SsbumpOutput output;
    output.file = folder_.path() / name;
    output.encoding = encoding;
    write_ssbump(output, {}, weights);
    return read_ssbump(output.file, {});
  }

 private:
  TempFolder folder_;
};

TEST_F(DecodeSsbump, GivesAFlatPatchTheFlatBakeUnderEachScaleAndDepth) {
  for (const auto scale : {SsbumpScale::third, SsbumpScale::ndotb, SsbumpScale::mod2x}) {
    for (const auto alpha : {SsbumpAlpha::none, SsbumpAlpha::up, SsbumpAlpha::ao}) {
      for (const char* name : {"a.exr", "a.png", "a.tga"}) {
        const SsbumpPicture map =
            stored(filled(16, 16, SsbumpWeights::channels, 1), {scale, Handed::right, alpha}, name);
        const FloatImage lit = decode_ssbump(sided(), map, DecodeVariant::squared);
        double mean = 0;
        for (const float value : lit.data()) mean += value / static_cast<double>(lit.data().size());
        // 8 bits and dither: a step of 1/255 in 0.29 is 1.4 %, its noise averages out.
        EXPECT_NEAR(mean, 0.5, name[2] == 'e' ? 1e-6 : 1e-3) << name << name_of(scale);
      }
    }
  }
}

TEST_F(DecodeSsbump, IsTheSumOfWeightsTimesMapsInEitherHandedness) {
  const FloatImage weights = some_weights();
  const FloatImage right =
      decode_ssbump(sided(), stored(weights, {SsbumpScale::ndotb, Handed::right, SsbumpAlpha::none}, "r.exr"),
                    DecodeVariant::squared);
  const FloatImage left =
      decode_ssbump(sided(), stored(weights, {SsbumpScale::mod2x, Handed::left, SsbumpAlpha::none}, "l.tif"),
                    DecodeVariant::squared);
  for (int x = 0; x < 6; ++x) {
    const auto w = weights.texel(x, 2);
    EXPECT_NEAR(right.texel(x, 2)[0], (0.8F * w[0] + 0.5F * w[1] + 0.2F * w[2]) / 3, 1e-6);
    EXPECT_NEAR(left.texel(x, 2)[1], right.texel(x, 2)[1], 0.02);  // 8 bits
  }
}

TEST_F(DecodeSsbump, FollowsTheGreenOfTheLightmap) {
  const SsbumpPicture map = stored(some_weights(), {}, "a.exr");
  Lightmap down = sided();
  down.metadata.green = Green::y_down;
  std::swap(down.layers["rnm1"], down.layers["rnm2"]);  // the same light
  const FloatImage a = decode_ssbump(sided(), map, DecodeVariant::squared);
  const FloatImage b = decode_ssbump(down, map, DecodeVariant::squared);
  for (std::size_t i = 0; i < a.data().size(); ++i) EXPECT_NEAR(a.data()[i], b.data()[i], 1e-6);
}

TEST_F(DecodeSsbump, TakesWhatTheMapsShareFromTheFourthDirection) {
  const FloatImage weights = some_weights();
  const SsbumpPicture map = stored(weights, {SsbumpScale::third, Handed::right, SsbumpAlpha::up}, "a.exr");
  const FloatImage lit = decode_ssbump(sided(), map, DecodeVariant::squared);
  const auto w = weights.texel(1, 1);
  EXPECT_NEAR(lit.texel(1, 1)[2], (0.6F * w[0] + 0.3F * w[1]) / 3 + 0.2F * w[SsbumpWeights::up], 1e-6);
}

struct Fit {
  double error = 0;     // RMS against the exact shadow
  double contrast = 0;  // how much of the shadow's own contrast is there: covariance over variance
};

/// One far light after the other over a bumpy field, decoded and held against what it lights exactly.
Fit fit_to_shadows(const HeightField& field, SsbumpPicture map, SsbumpAlpha alpha) {
  map.metadata.alpha = alpha;
  constexpr int light_count = 24;
  double squares = 0, e = 0, t = 0, et = 0, tt = 0, count = 0;
  for (int k = 0; k < light_count; ++k) {
    const double z = (k + 0.5) / light_count, turn = k * pi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
    const Vec3 light(Vec3d(r * std::cos(turn), r * std::sin(turn), z));
    Lightmap lightmap = sided();
    lightmap.layers["flat"] = filled(2, 2, 3, light.z);
    const auto maps = rnm_scaled_to_flat(rnm_linear_weights(light), light.z);
    for (std::size_t i = 0; i < 3; ++i)
      lightmap.layers[std::string(rnm_layers[i])] = filled(2, 2, 3, maps[i]);
    const FloatImage lit = decode_ssbump(lightmap, map, DecodeVariant::squared);
    const FloatImage shadows = height_shadows(field, light);
    for (std::size_t i = 0; i < shadows.data().size(); ++i) {
      const double truth = shadows.data()[i], got = lit.data()[3 * i] / light.z;
      squares += std::pow((got - truth) * light.z, 2);
      e += got, t += truth, et += got * truth, tt += truth * truth, ++count;
    }
  }
  const double variance = tt / count - std::pow(t / count, 2);
  return {std::sqrt(squares / count), (et / count - e * t / (count * count)) / variance};
}

TEST_F(DecodeSsbump, GetsSharperShadowsFromTheFourthDirection) {
  constexpr int side = 64;
  HeightField field{FloatImage(side, side, 1), WrapMode::wrap, WrapMode::wrap};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      field.heights.texel(x, y)[0] =
          static_cast<float>(6 * std::sin(2 * pi * x * 2 / side) * std::cos(2 * pi * y * 2 / side));
  GenerateOptions options;
  options.power = 4;
  SsbumpPicture map;
  map.weights = generate(field, options).image;
  const Fit three = fit_to_shadows(field, map, SsbumpAlpha::none);
  const Fit four = fit_to_shadows(field, map, SsbumpAlpha::up);
  EXPECT_LT(four.error, 0.9 * three.error);
  EXPECT_GT(four.contrast, 1.15 * three.contrast);
}

/// Without shadows a map says what the linear decode of its normals says, times what the scale leaves out.
TEST_F(DecodeSsbump, OfANormalMapIsTheLinearDecode) {
  FloatImage normals(3, 1, 3);
  const Vec3 tilted = Vec3(0.3F, -0.2F, 0.9F).normalized();
  for (int x = 0; x < 3; ++x)
    std::ranges::copy(std::array{tilted.x, tilted.y, tilted.z}, normals.texel(x, 0).begin());
  const SsbumpPicture map = stored(weights_of_normals(normals), {}, "a.exr");
  const FloatImage lit = decode_ssbump(sided(), map, DecodeVariant::squared);
  Lightmap signed_maps = sided();
  signed_maps.metadata.normalize = Normalize::none;
  const FloatImage linear = decode(signed_maps, {normals, Green::y_up}, DecodeVariant::linear);
  EXPECT_NEAR(lit.texel(0, 0)[0], linear.texel(0, 0)[0] / std::sqrt(3.0F), 1e-6);
}

TEST_F(DecodeSsbump, RefusesWhatContradictsTheFile) {
  (void)stored(some_weights(), {}, "a.exr");
  const SsbumpPicture map = stored(some_weights(), {}, "b.exr");
  EXPECT_TRUE(map.knows_itself);
  const TempFolder folder;
  SsbumpOutput output;
  output.file = folder.path() / "a.tga";
  write_ssbump(output, {}, some_weights());
  SsbumpHints told;
  told.scale = SsbumpScale::mod2x;
  EXPECT_THROW((void)read_ssbump(output.file, told), Error);
  told.scale = SsbumpScale::third;
  EXPECT_NO_THROW((void)read_ssbump(output.file, told));
}

}  // namespace
}  // namespace rnmbake
