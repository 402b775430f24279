#include "pipeline/validate/decompose.h"

#include "base/files.h"
#include "image/layered_exr.h"
#include "lightmap/metadata.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

constexpr int side = 32;
constexpr double noise = 0.02;

/// Folders of one object 'wall' with one basis, whose every texel is a value plus normal noise.
class Folders {
 public:
  /// A traced one, which knows its noise.
  std::filesystem::path traced(const std::string& name, double value) { return write(name, value, true); }
  Halves halves(const std::string& name, double value) {
    return {write(name + "-1", value, false), write(name + "-2", value, false)};
  }

 private:
  std::filesystem::path write(const std::string& name, double value, bool knows_noise) {
    std::mt19937 random(++seed_);
    std::normal_distribution<double> normal(0, noise);
    LayeredImage image;
    image.layers.push_back({"rnm0", {"R", "G", "B"}, picture(3, [&] { return value + normal(random); })});
    if (knows_noise)
      image.layers.push_back({"rnm0_stderr", {"R", "G", "B"}, picture(3, [] { return noise; })});
    image.layers.push_back({"coverage", {""}, picture(1, [] { return 1.0; })});
    LightmapMetadata metadata;
    metadata.bases = {rnm_set().directions.front()};
    metadata.seed = static_cast<int>(seed_);
    metadata.object = "wall";
    write_metadata(metadata, image);
    const auto dir = folder_.path() / name;
    make_folders(dir);
    write_exr(dir / "wall.exr", image, Depth::full);
    const nlohmann::json object{{"key", "wall"}, {"status", "baked"}, {"files", {"wall.exr"}}};
    write_atomically(dir / "manifest.json",
                     nlohmann::json{{"schema_version", 1}, {"objects", {object}}}.dump());
    return dir;
  }

  static FloatImage picture(int channels, const std::function<double()>& value) {
    FloatImage image(side, side, channels);
    for (float& v : image.data()) v = static_cast<float>(value());
    return image;
  }

  TempFolder folder_;
  std::uint32_t seed_ = 0;
};

const DecompositionRow& row(const BasisDecomposition& basis, const std::string& name) {
  for (const DecompositionRow& one : basis.rows) {
    if (one.name == name) return one;
  }
  throw std::runtime_error("no row " + name);
}

// Means over 32 x 32 texels and 3 colours have a standard error of noise / 55; differences a little more.
constexpr double allowed = 5 * noise / 55 * 2;

DecomposeInput lambert_input(Folders& folders) {
  DecomposeInput input;
  input.truth = folders.traced("truth", 1.0);
  input.emulated = {{"tilt clamp", folders.traced("one", 0.9)},
                    {"bump shadowing", folders.traced("two", 0.7)}};
  input.recipe = folders.halves("recipe", 0.7);
  input.receiver = folders.halves("receiver", 1.0);
  return input;
}

TEST(Decompose, EachCauseIsWhatItAdds) {
  Folders folders;
  const auto result = decompose(lambert_input(folders));
  ASSERT_EQ(result.size(), 2U);
  EXPECT_EQ(result[0].subject, "scene");
  EXPECT_EQ(result[1].subject, "wall");
  for (const Decomposition& one : result) {
    const BasisDecomposition& basis = one.bases.at(0);
    EXPECT_EQ(basis.basis, "rnm0");
    EXPECT_NEAR(basis.reference_mean, 1, allowed);
    EXPECT_NEAR(row(basis, "tilt clamp").bias.value, -0.1, allowed);
    EXPECT_NEAR(row(basis, "bump shadowing").bias.value, -0.2, allowed);
    EXPECT_NEAR(row(basis, "bump shadowing").rmse.value, 0.2, allowed);
    EXPECT_NEAR(basis.total.relative_bias.value, -0.3, allowed);
    EXPECT_EQ(basis.rows.size(), 4U);
  }
}

TEST(Decompose, TheResidualOfACompleteExplanationIsNoise) {
  Folders folders;
  const auto result = decompose(lambert_input(folders));
  const BasisDecomposition& basis = result[0].bases.at(0);
  const DecompositionRow& residual = row(basis, "residual");
  EXPECT_LE(std::abs(residual.bias.value), allowed);
  EXPECT_LE(residual.rmse.low95, 0);
  EXPECT_LE(residual.rmse.value, noise / 3);
  EXPECT_NEAR(row(basis, "noise").rmse.value, noise / std::sqrt(2), noise / 20);  // the mean of two halves
}

TEST(Decompose, WhatNoCauseExplainsIsLeftOver) {
  Folders folders;
  DecomposeInput input = lambert_input(folders);
  input.recipe = folders.halves("other", 0.65);
  const auto result = decompose(input);
  const Statistic residual = row(result[0].bases.at(0), "residual").bias;
  EXPECT_NEAR(residual.value, -0.05, allowed);
  EXPECT_LT(residual.high95, 0);
}

TEST(Decompose, OwnMaterialsHaveTwoRowsAndEverythingAddsUp) {
  Folders folders;
  DecomposeInput input = lambert_input(folders);
  input.own_receiver = folders.halves("own-receiver", 1.05);
  input.own_recipe = folders.halves("own-recipe", 0.85);
  const auto result = decompose(input);
  const BasisDecomposition& basis = result[0].bases.at(0);
  EXPECT_NEAR(row(basis, "model difference").bias.value, 0.05, allowed);
  EXPECT_NEAR(row(basis, "non-Lambertian diffuse").bias.value, 0.1, allowed);
  EXPECT_NEAR(basis.total.bias.value, -0.15, allowed);
  double sum = 0;
  for (const DecompositionRow& one : basis.rows) sum += one.bias.value;
  EXPECT_NEAR(sum, basis.total.bias.value, 1e-6);
}

}  // namespace
}  // namespace rnmbake
