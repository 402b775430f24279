// rnmbake ssbump with Blender: meshes read from files, and height maps baked by Cycles. Scenes:
// scenes/ssbump_cases.py.
#include "base/error.h"
#include "blender/blender_session.h"
#include "blender/late_blender.h"
#include "config/resolve.h"
#include "encoding/rnm.h"
#include "pipeline/ssbump/ssbump_blender.h"
#include "pipeline/ssbump/ssbump_mesh.h"
#include "ssbump/generate/generate.h"
#include "with_blender/survey_session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

/// The meshes, built once for all tests, and a Blender to read them.
class SsbumpFiles : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    session_ = new SurveySession;
    session_->build("ssbump_cases.py", {session_->file("").string()});
  }
  static void TearDownTestSuite() {
    delete session_;
    session_ = nullptr;
  }

  static fs::path file(const std::string& name) { return session_->file(name); }

  static SsbumpMesh measure(const SsbumpMeshOptions& options) {
    const ResolvedConfig config = resolve({}, {}, {});
    LateBlender blender(config.globals);
    BlenderSession session(config, blender);
    return measure_ssbump_mesh(session, options);
  }

  static SsbumpMeshOptions options_for(const std::string& high, const std::vector<std::string>& onto) {
    SsbumpMeshOptions options;
    options.high = file(high);
    options.onto = onto;
    options.measure.width = options.measure.height = 16;
    options.measure.cage = 0.5;
    return options;
  }

  static std::string refusal(const SsbumpMeshOptions& options) {
    try {
      (void)measure(options);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::invalid_input);
      return error.what();
    }
    return "";
  }

  static SurveySession* session_;
};

SurveySession* SsbumpFiles::session_ = nullptr;

/// Of a channel over all texels, with the standard error of the mean.
std::pair<double, double> mean_of(const FloatImage& image, std::size_t channel) {
  double sum = 0, squares = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const double value = image.texel(x, y)[channel];
      sum += value;
      squares += value * value;
    }
  }
  const auto count = double(image.texels());
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / count)};
}

/// Channel 0 with the wall on the right: tests/ssbump/mesh/mesh_occlusion_test.cpp.
double lune() {
  return (1 - std::sqrt(2.0 / 3)) / (1 + std::sqrt(1.0 / 3));
}

TEST_F(SsbumpFiles, EveryFormatGivesTheWallsClosedForm) {
  for (const char* ending : {".blend", ".glb", ".obj"}) {
    const fs::path low = file(std::string("low") + ending);
    if (!fs::exists(low)) {
      GTEST_LOG_(WARNING) << "this Blender writes no " << ending << ": not tested";
      continue;
    }
    const SsbumpMesh mesh = measure(options_for(std::string("detail") + ending, {low.string()}));
    ASSERT_EQ(mesh.objects.size(), 1U) << ending;
    EXPECT_EQ(mesh.maps.surfaces[0].texels, 256U) << ending;
    EXPECT_EQ(mesh.maps.surfaces[0].missed, 0U) << ending;
    const auto [right, right_error] = mean_of(mesh.maps.weights.image, 0);
    EXPECT_NEAR(right, lune(), 4 * right_error) << ending;
    const auto [up, up_error] = mean_of(mesh.maps.weights.image, SsbumpWeights::up);
    EXPECT_NEAR(up, 0.5, 4 * up_error) << ending;
    const auto [left, left_error] = mean_of(mesh.maps.weights.image, 1);
    EXPECT_GT(left, right + 0.3) << ending;
  }
}

TEST_F(SsbumpFiles, BothMeshesMayLieInOneFile) {
  const SsbumpMesh mesh = measure([] {
    SsbumpMeshOptions options = options_for("both.blend", {"low"});
    options.high_objects = {"det*"};
    return options;
  }());
  EXPECT_EQ(mesh.objects, std::vector<std::string>{"low"});
  EXPECT_EQ(mesh.maps.surfaces[0].missed, 0U);
}

TEST_F(SsbumpFiles, MirroredObjectsKeepTheirFrontsAndTheirFrames) {
  SsbumpMeshOptions options = options_for("both.blend", {"low"});
  options.high_objects = {"turned"};
  const SsbumpMesh turned = measure(options);
  EXPECT_EQ(turned.maps.surfaces[0].behind, 0U);
  const auto [right, right_error] = mean_of(turned.maps.weights.image, 0);
  EXPECT_NEAR(right, lune(), 4 * right_error);

  options.onto = {"mirrored"};
  options.high_objects = {"detail"};
  const auto [left, left_error] =
      mean_of(measure(options).maps.weights.image, 0);  // u runs away from the wall
  EXPECT_NEAR(left, 1 - lune(), 4 * left_error);
}

TEST_F(SsbumpFiles, WhatCannotBeMeasuredIsNamed) {
  SsbumpMeshOptions options = options_for("both.blend", {"bare"});
  options.high_objects = {"detail"};
  EXPECT_NE(refusal(options).find("object 'bare' has no UVs"), std::string::npos) << refusal(options);
  options.onto = {"twice"};
  EXPECT_NE(refusal(options).find("UVs of object 'twice' overlap each other"), std::string::npos);
  options.onto = {"low", "twice"};
  EXPECT_NE(refusal(options).find("'twice'"), std::string::npos);
  options.onto = {"far"};
  EXPECT_NE(refusal(options).find("Raise --cage"), std::string::npos) << refusal(options);
  options.onto = {"twice"};
  options.allow_overlap = true;
  EXPECT_EQ(measure(options).maps.surfaces[0].missed, 0U);
}

/// A bump and a dip, smooth, wrapped.
HeightField waves(int side) {
  HeightField field;
  field.heights = FloatImage(side, side, 1);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      field.heights.texel(x, y)[0] =
          static_cast<float>(1.5 * std::sin(2 * pi * x / side) * std::cos(2 * pi * y / side));
    }
  }
  return field;
}

constexpr int mesh_samples = 1024;

SsbumpWeights bake(const HeightField& field, SsbumpBlenderOptions::Lights lights) {
  const ResolvedConfig config = resolve({}, {}, {});
  LateBlender blender(config.globals);
  BlenderSession session(config, blender);
  SsbumpBlenderOptions options;
  options.lights = lights;
  options.samples = mesh_samples;
  return bake_height_map(session, field, options);
}

/// How far a share of `draws` lies from the share expected, as a square in standard errors. Where draws of
/// one kind are few, errors are not normal (3 expected, 8 seen is no rarity); the binomial likelihood holds
/// there too: by Chernoff's bound more than z^2 comes with a probability below 2 exp(-z^2 / 2).
double squared_errors(double share, double expected, double draws) {
  const auto term = [](double p, double q) { return p > 0 ? p * std::log(p / q) : 0; };
  return 2 * draws * (term(share, expected) + term(1 - share, 1 - expected));
}

/// Cycles draws from the cosine lobe about an axis; a weight is a share of what that sends above the horizon.
double draws_of(std::size_t channel) {
  const double up = channel < 3 ? double{rnm_basis()[channel].z} : 1;
  return mesh_samples * (1 + up) / 2;
}

void expect_the_horizon(const HeightField& field) {
  const SsbumpWeights cycles = bake(field, SsbumpBlenderOptions::Lights::sky);
  GenerateOptions
      fine;  // to 1e-4; 64 azimuths are off by up to 2e-3 at single texels, more than this noise allows
  fine.azimuths = 512;
  const SsbumpWeights horizon = generate(field, fine);
  for (std::size_t channel = 0; channel < SsbumpWeights::channels; ++channel) {
    double squares = 0, sum = 0;
    for (std::size_t i = channel; i < cycles.image.data().size(); i += SsbumpWeights::channels) {
      const double share = cycles.image.data()[i];
      const double expected = std::clamp(double{horizon.image.data()[i]}, 5e-4, 1 - 5e-4);
      const double errors = squared_errors(share, expected, draws_of(channel));
      EXPECT_LT(errors, 5 * 5) << i << ": " << share << " for " << expected;
      squares += errors;
      sum += share - horizon.image.data()[i];
    }
    const auto texels = double(field.heights.texels());
    EXPECT_LT(squares / texels, 1.5) << channel;
    EXPECT_LT(std::abs(sum / texels), 0.003) << channel;
  }
}

TEST(SsbumpBlender, TheSkyAgreesWithTheHorizon) {
  HeightField field = waves(12);
  expect_the_horizon(field);
  field.x = WrapMode::mirror;
  field.y = WrapMode::none;
  expect_the_horizon(field);
}

TEST(SsbumpBlender, NothingShadesAFlatMap) {
  HeightField field;
  field.heights = FloatImage(5, 3, 1);
  for (const auto lights : {SsbumpBlenderOptions::Lights::sky, SsbumpBlenderOptions::Lights::area}) {
    const SsbumpWeights weights = bake(field, lights);
    for (const float weight : weights.image.data()) EXPECT_NEAR(weight, 1, 1e-5);
  }
}

TEST(SsbumpBlender, AreaLightsOrderTexelsAsTheHorizonDoes) {
  const HeightField field = waves(12);
  const SsbumpWeights lamps = bake(field, SsbumpBlenderOptions::Lights::area), horizon = generate(field, {});
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const std::size_t n = field.heights.texels();
    double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double x = lamps.image.data()[i * SsbumpWeights::channels + channel];
      const double y = horizon.image.data()[i * SsbumpWeights::channels + channel];
      a += x, b += y, aa += x * x, bb += y * y, ab += x * y;
    }
    const auto count = double(n);
    const double correlation = (ab - a * b / count) / std::sqrt((aa - a * a / count) * (bb - b * b / count));
    EXPECT_GT(correlation, 0.8) << channel;
  }
}

}  // namespace
}  // namespace rnmbake
