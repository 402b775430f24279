#include "lightmap/merge.h"

#include "base/error.h"
#include "encoding/rnm.h"
#include "lightmap/half_range.h"
#include "lightmap/layout.h"
#include "support/pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

constexpr float quiet_nan = std::numeric_limits<float>::quiet_NaN();

/// A uniform sky over `width` x `height` texels, the last column not covered and full of rubbish.
TargetBakes sky(int width, int height) {
  TargetBakes bakes;
  const auto basis = rnm_basis();
  for (std::size_t i = 0; i < 3; ++i)
    bakes.bases.push_back(
        {"rnm" + std::to_string(i), basis[i], filled(width, height, 3, (1 + basis[i].z) / 2)});
  bakes.bases.push_back({"flat", Vec3(0, 0, 1), filled(width, height, 3, 1)});
  bakes.coverage = filled(width, height, 1, 1);
  for (int y = 0; y < height; ++y) {
    bakes.coverage.texel(width - 1, y)[0] = 0;
    for (BasisBake& bake : bakes.bases) std::ranges::fill(bake.radiance.texel(width - 1, y), 777.0F);
  }
  return bakes;
}

const FloatImage& layer(const MergedLightmap& merged, const std::string& name) {
  return merged.image.find(name)->pixels;
}

template <typename Action>
void expect_code(ExitCode code, Action action) {
  try {
    action();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
  }
}

TEST(Merge, LayersAreFlatFirstThenBasesThenCoverage) {
  const MergedLightmap merged = merge(sky(5, 3), {});
  std::vector<std::string> names;
  for (const Layer& l : merged.image.layers) names.push_back(l.name);
  EXPECT_EQ(names, (std::vector<std::string>{"", "rnm0", "rnm1", "rnm2", "coverage"}));
  EXPECT_EQ(merged.counts.covered_texels, 12U);
  EXPECT_EQ(merged.counts.non_finite + merged.counts.fireflies + merged.counts.repaired +
                merged.counts.beyond_half + merged.counts.negative + merged.counts.black +
                merged.counts.unscalable,
            0U);
}

TEST(Merge, WithoutFlatThereIsNoUnnamedLayer) {
  TargetBakes bakes = sky(2, 2);
  bakes.bases.pop_back();
  EXPECT_EQ(merge(bakes, {}).image.find(""), nullptr);
}

TEST(Merge, ValuesStayExactWithoutNormalizing) {
  const MergedLightmap merged = merge(sky(5, 3), {.depth = Depth::full});
  EXPECT_EQ(layer(merged, "rnm1").texel(1, 2)[1], (1 + rnm_basis()[1].z) / 2);
}

TEST(Merge, UncoveredTexelsAreDilatedOrZeroAndCoverageIsNot) {
  EXPECT_EQ(layer(merge(sky(5, 3), {.dilate = 1}), "").texel(4, 1)[0], 1);
  const MergedLightmap merged = merge(sky(5, 3), {.dilate = 0});
  EXPECT_EQ(layer(merged, "").texel(4, 1)[0], 0);
  EXPECT_EQ(layer(merged, "coverage").texel(4, 1)[0], 0);
  EXPECT_EQ(layer(merge(sky(5, 3), {.dilate = 9}), "coverage").texel(4, 1)[0], 0);
}

TEST(Merge, NormalizedMapsHaveTheFlatBakeAsTheirMean) {
  TargetBakes bakes = sky(8, 8);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 2);
  for (BasisBake& bake : bakes.bases)
    for (float& value : bake.radiance.data()) value = uniform(random);
  const MergedLightmap merged =
      merge(bakes, {.normalize = Normalize::flat, .dilate = 0, .depth = Depth::full});
  const auto& flat = layer(merged, "").data();
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const float sum =
        layer(merged, "rnm0").data()[i] + layer(merged, "rnm1").data()[i] + layer(merged, "rnm2").data()[i];
    ASSERT_NEAR(sum / 3, flat[i], 2e-6);
  }
}

TEST(Merge, NormalizingThreeZerosTakesFlatAndCountsIt) {
  TargetBakes bakes = sky(3, 1);
  for (int i = 0; i < 3; ++i)
    std::ranges::fill(bakes.bases[static_cast<std::size_t>(i)].radiance.texel(0, 0), 0.0F);
  const MergedLightmap merged = merge(bakes, {.normalize = Normalize::flat, .depth = Depth::full});
  EXPECT_EQ(merged.counts.unscalable, 3U);  // one texel, three colours
  EXPECT_EQ(layer(merged, "rnm2").texel(0, 0)[1], 1);
}

TEST(Merge, NormalizingNeedsAllFour) {
  for (std::size_t i = 0; i < 4; ++i) {
    TargetBakes bakes = sky(2, 2);
    bakes.bases.erase(bakes.bases.begin() + static_cast<std::ptrdiff_t>(i));
    expect_code(ExitCode::usage, [&] { (void)merge(bakes, {.normalize = Normalize::flat}); });
  }
}

TEST(Merge, FaultsAreCountedAndOnlyRepairedOnRequest) {
  TargetBakes bakes = sky(9, 9);
  bakes.bases[0].radiance.texel(1, 1)[0] = quiet_nan;
  bakes.bases[2].radiance.texel(1, 1)[0] = quiet_nan;  // the same texel again: one
  bakes.bases[1].radiance.texel(4, 4)[1] = std::numeric_limits<float>::infinity();
  std::ranges::fill(bakes.bases[3].radiance.texel(6, 6), 1000.0F);
  const MergedLightmap kept = merge(bakes, {.depth = Depth::full});
  EXPECT_EQ(kept.counts.non_finite, 2U);
  EXPECT_EQ(kept.counts.fireflies, 1U);
  EXPECT_EQ(kept.counts.repaired, 0U);
  EXPECT_TRUE(std::isnan(layer(kept, "rnm0").texel(1, 1)[0]));
  EXPECT_EQ(layer(kept, "").texel(6, 6)[0], 1000);
  const MergedLightmap repaired = merge(bakes, {.repair = true, .depth = Depth::full});
  EXPECT_EQ(repaired.counts.non_finite, 2U);
  EXPECT_EQ(repaired.counts.fireflies, 1U);
  EXPECT_EQ(repaired.counts.repaired, 3U);
  EXPECT_NEAR(layer(repaired, "rnm0").texel(1, 1)[0], 0.788675, 1e-6);
  EXPECT_NEAR(layer(repaired, "").texel(6, 6)[0], 1, 1e-6);
}

TEST(Merge, HalfRangeIsClampedAndCountedOnceBeforeDilation) {
  TargetBakes bakes = sky(4, 4);
  for (float& value : bakes.bases[3].radiance.data()) value = 1e6F;
  bakes.bases[0].radiance.texel(0, 0)[2] = -1e6F;
  const MergedLightmap merged = merge(bakes, {.dilate = 2});
  EXPECT_EQ(merged.counts.beyond_half, 12U * 3 + 1);
  EXPECT_EQ(merged.counts.negative, 1U);
  EXPECT_EQ(layer(merged, "").texel(3, 3)[0], 65504);
  EXPECT_EQ(layer(merged, "rnm0").texel(0, 0)[2], -65504);
  const MergedLightmap full = merge(bakes, {.depth = Depth::full});
  EXPECT_EQ(full.counts.beyond_half, 0U);
  EXPECT_EQ(layer(full, "").texel(0, 0)[0], 1e6F);
}

TEST(Merge, BlackMeansZeroInEveryBasis) {
  TargetBakes bakes = sky(4, 4);
  for (BasisBake& bake : bakes.bases) std::ranges::fill(bake.radiance.texel(0, 0), 0.0F);
  std::ranges::fill(bakes.bases[0].radiance.texel(1, 1), 0.0F);
  EXPECT_EQ(merge(bakes, {}).counts.black, 1U);
}

TEST(Merge, FramesKeepTheirChannelsAndAreNotDilated) {
  TargetBakes bakes = sky(4, 4);
  bakes.tangent = filled(4, 4, 4, 0.5F);
  bakes.normal = filled(4, 4, 3, 0.25F);
  const MergedLightmap merged = merge(bakes, {});
  EXPECT_EQ(merged.image.find("tangent")->channels, (std::vector<std::string>{"X", "Y", "Z", "S"}));
  EXPECT_EQ(merged.image.find("normal")->channels, (std::vector<std::string>{"X", "Y", "Z"}));
  EXPECT_EQ(layer(merged, "normal").texel(3, 0)[0], 0);
  EXPECT_EQ(layer(merged, "normal").texel(0, 0)[0], 0.25F);
}

TEST(Merge, WhatDoesNotFitIsRefused) {
  expect_code(ExitCode::invalid_input, [] { (void)merge({}, {}); });
  TargetBakes bakes = sky(4, 4);
  bakes.bases[1].radiance = FloatImage(4, 5, 3);
  expect_code(ExitCode::invalid_input, [&] { (void)merge(bakes, {}); });
  bakes.bases[1].radiance = FloatImage(4, 4, 1);
  expect_code(ExitCode::invalid_input, [&] { (void)merge(bakes, {}); });
}

TEST(HalfRange, LimitsAreExact) {
  FloatImage image(5, 1, 1);
  image.data() = {65504, 65505, -65505, quiet_nan, std::numeric_limits<float>::infinity()};
  EXPECT_EQ(clamp_to_half(image), 2U);
  EXPECT_EQ(image.data()[0], 65504);
  EXPECT_EQ(image.data()[1], 65504);
  EXPECT_EQ(image.data()[2], -65504);
  EXPECT_TRUE(std::isnan(image.data()[3]));
  EXPECT_TRUE(std::isinf(image.data()[4]));
}

TEST(Layout, EveryLayerBecomesAFileOfPlainChannels) {
  MergedLightmap merged = merge(sky(2, 2), {});
  merged.image.attributes["rnmbake:units"] = std::string("E/pi");
  const auto files = one_file_per_layer(std::move(merged.image));
  ASSERT_EQ(files.size(), 5U);
  EXPECT_EQ(files[0].name, "flat");
  EXPECT_EQ(files[2].name, "rnm1");
  EXPECT_EQ(files[2].image.layers[0].name, "");
  EXPECT_EQ(files[2].image.attributes.at("rnmbake:layer"), Attribute(std::string("rnm1")));
  EXPECT_EQ(files[2].image.attributes.at("rnmbake:units"), Attribute(std::string("E/pi")));
  EXPECT_EQ(files[4].image.layers[0].channels, (std::vector<std::string>{"Y"}));
}

}  // namespace
}  // namespace rnmbake
