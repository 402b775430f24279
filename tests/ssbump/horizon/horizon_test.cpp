#include "ssbump/generate/generate.h"
#include "ssbump/height_fields.h"
#include "ssbump/horizon/horizon_sweep.h"
#include "support/pictures.h"

#include <gtest/gtest.h>

using namespace rnmbake;

namespace {

struct Errors {
  double rms = 0, largest = 0;
  double estimated = 0;  // RMS
  int azimuths = 0;
};

Errors errors(const HeightField& field, const GenerateOptions& options, int every) {
  const SsbumpWeights weights = generate(field, options);
  const HeightRays surface(field);
  Errors result{.estimated = weights.rmse, .azimuths = weights.azimuths};
  int count = 0;
  for (int i = 0; i < field.width() * field.height(); i += every) {
    const int x = i % field.width(), y = i / field.width();
    const Channels exact = exact_weights(surface, x, y, options.power);
    for (std::size_t c = 0; c < exact.size(); ++c, ++count) {
      const double error = std::abs(weights.image.texel(x, y)[c] - exact[c]);
      result.rms += error * error;
      result.largest = std::max(result.largest, error);
    }
  }
  result.rms = std::sqrt(result.rms / count);
  return result;
}

TEST(Horizon, NothingStandsOutOfAFlatMap) {
  for (const WrapMode beyond : {WrapMode::wrap, WrapMode::mirror, WrapMode::none}) {
    for (const auto& [width, height] : {std::pair(1, 1), {1, 7}, {9, 1}, {17, 33}}) {
      const SsbumpWeights weights =
          generate(field_of(width, height, beyond, [](int, int) { return 3.5; }), {});
      for (const float weight : weights.image.data()) ASSERT_NEAR(weight, 1, 2e-6);
    }
  }
}

TEST(Horizon, IsThatOfTheBilinearSurface) {
  for (const WrapMode beyond : {WrapMode::wrap, WrapMode::mirror, WrapMode::none}) {
    const Errors found = errors(rough_field(128, 160, beyond, 10), {}, 397);
    EXPECT_LE(found.rms, 0.001);
    EXPECT_LE(found.largest, 0.01);
  }
}

TEST(Horizon, KeepsToItsBoundsOnSteepWavesWithTwiceTheAzimuths) {
  // slopes up to 3: lines that pass beside a texel's centre must not make waves stand in their own light
  const HeightField waves = field_of(128, 128, WrapMode::wrap, [](int x, int y) {
    return 16 * (std::sin(2 * pi * x / 64) + std::sin(2 * pi * y / 64));
  });
  GenerateOptions options;
  options.azimuths = 128;
  const Errors found = errors(waves, options, 397);
  EXPECT_LE(found.rms, 0.001);
  EXPECT_LE(found.largest, 0.01);
}

TEST(Horizon, SeesTheMiddlesOfTwistedPatches) {
  // beside a step's corner: across that patch the surface bulges over the straight line between its edges
  const HeightField corner =
      field_of(128, 128, WrapMode::wrap, [](int x, int y) { return x < 64 && y < 64 ? 6 : 0; });
  GenerateOptions options;
  options.azimuths = 128;
  const SsbumpWeights weights = generate(corner, options);
  const HeightRays surface(corner);
  for (const auto& [x, y] : {std::pair(65, 65), {65, 66}, {66, 65}, {66, 66}, {67, 66}, {65, 63}}) {
    const Channels exact = exact_weights(surface, x, y, 1);
    for (std::size_t c = 0; c < exact.size(); ++c)
      EXPECT_NEAR(weights.image.texel(x, y)[c], exact[c], 0.01) << x << ' ' << y << ' ' << c;
  }
}

TEST(Horizon, LooksAlongABorderThatGoesOn) {
  // the groove's far side goes on behind the border and is seen at any angle to it
  const HeightField groove =
      field_of(128, 128, WrapMode::none, [](int x, int) { return 4 * std::abs(x - 64); });
  const Errors found = errors(groove, {}, 397);
  EXPECT_LE(found.rms, 0.001);
  EXPECT_LE(found.largest, 0.01);
}

TEST(Horizon, MoreAzimuthsAndNearRowsComeCloser) {
  const HeightField field = rough_field(128, 128, WrapMode::wrap, 30);
  GenerateOptions options;
  const double rms = errors(field, options, 397).rms;
  options.azimuths = 256;
  options.near_rows = 32;
  EXPECT_LT(errors(field, options, 397).rms, rms / 1.5);
}

/// Terraces with cliffs of `high` texels.
HeightField cliffs(double high, WrapMode beyond = WrapMode::wrap) {
  HeightField field = rough_field(96, 96, beyond, 24);
  for (float& height : field.heights.data()) height = static_cast<float>(high * std::floor(height / 3));
  return field;
}

TEST(Horizon, AzimuthsAreDoubledUntilCliffsAreNearEnough) {
  for (const WrapMode beyond : {WrapMode::wrap, WrapMode::mirror, WrapMode::none}) {
    const Errors found = errors(cliffs(6, beyond), {}, 97);
    EXPECT_GT(found.azimuths, 64);
    EXPECT_LE(found.rms, 0.001);
    EXPECT_LE(found.largest, 0.01);
    EXPECT_LE(found.estimated, 0.001);
    EXPECT_GT(found.estimated, found.rms / 3);
    EXPECT_LT(found.estimated, found.rms * 3);
  }
}

TEST(Horizon, SmoothWavesDoWithTheFirstAzimuths) {
  const Errors found =
      errors(field_of(96, 96, WrapMode::wrap,
                      [](int x, int y) { return 4 * std::sin(2 * pi * x / 48) * std::cos(2 * pi * y / 32); }),
             {}, 97);
  EXPECT_EQ(found.azimuths, 64);
  EXPECT_LE(found.rms, 0.001);
}

TEST(Horizon, ASmallerErrorTakesMoreAzimuths) {
  GenerateOptions options;
  int azimuths = 0;
  double rms = 1;
  for (const double error : {0.01, 1e-3, 2e-4}) {
    options.error = error;
    const Errors found = errors(cliffs(2), options, 97);
    EXPECT_GT(found.azimuths, azimuths) << error;
    EXPECT_LT(found.rms, rms) << error;
    azimuths = found.azimuths;
    rms = found.rms;
  }
}

TEST(Horizon, AzimuthsThatAreToldAreTaken) {
  GenerateOptions options;
  options.azimuths = 32;
  const SsbumpWeights weights = generate(cliffs(6), options);
  EXPECT_EQ(weights.azimuths, 32);
  EXPECT_LT(weights.rmse, 0);  // not known
}

TEST(Horizon, OtherPowersComeOutOfTables) {
  GenerateOptions options;
  options.power = 4;
  const Errors found = errors(rough_field(128, 128, WrapMode::wrap, 10), options, 397);
  EXPECT_LE(found.rms, 0.002);
  EXPECT_LE(found.largest, 0.02);
}

TEST(Horizon, AtTheBottomOfAGrooveIsAClosedForm) {
  // tan(elevation) = s |cos azimuth| on both sides, and the mean of cos^2(elevation) is 1 / sqrt(1 + s^2)
  for (const double slope : {0.25, 1.0}) {
    const HeightField field =
        field_of(256, 256, WrapMode::wrap, [&](int x, int) { return slope * std::abs(x - 128); });
    const SsbumpWeights weights = generate(field, {});
    EXPECT_NEAR(weights.image.texel(128, 100)[SsbumpWeights::ambient], 1 / std::sqrt(1 + slope * slope),
                1e-4);
  }
}

/// By how much a tile differs that is moved by half its size, generated, and moved back.
double seam_of(const HeightField& field) {
  const int width = field.width(), height = field.height();
  const auto over = [&](int x, int y) {
    return std::pair((x + width / 2) % width, (y + height / 2) % height);
  };
  const HeightField moved = field_of(width, height, WrapMode::wrap, [&](int x, int y) {
    const auto [u, v] = over(x, y);
    return field.heights.texel(u, v)[0];
  });
  const FloatImage here = generate(field, {}).image, there = generate(moved, {}).image;
  double largest = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto [u, v] = over(x, y);
      for (std::size_t c = 0; c < SsbumpWeights::channels; ++c)
        largest = std::max(largest, std::abs(double{here.texel(u, v)[c]} - there.texel(x, y)[c]));
    }
  }
  return largest;
}

TEST(Horizon, ATileHasNoSeam) {
  EXPECT_LE(seam_of(rough_field(128, 256, WrapMode::wrap, 20)), 1e-5);
}

TEST(Horizon, ACliffAtTheSeamIsNoneEither) {
  // beside the cliff texels see its end exactly, where the line that passes them stands higher
  EXPECT_LE(seam_of(field_of(256, 256, WrapMode::wrap, [](int x, int y) { return 0.25 * x + 0.125 * y; })),
            1e-5);
  EXPECT_LE(seam_of(field_of(256, 256, WrapMode::wrap, [](int x, int) { return x < 128 ? 16 : 0; })), 1e-5);
}

TEST(Horizon, BandsAreTheWhole) {
  for (const WrapMode beyond : {WrapMode::wrap, WrapMode::mirror, WrapMode::none}) {
    const HeightField field = rough_field(70, 90, beyond, 20);
    GenerateOptions options;
    const FloatImage whole = generate(field, options).image;
    options.memory = 1;
    FloatImage parts(70, 90, SsbumpWeights::channels);
    int bands = 0, next = 0;
    generate_rows(field, options, [&](int first, const SsbumpWeights& rows) {
      EXPECT_EQ(first, next);
      next += rows.image.height();
      ++bands;
      std::ranges::copy(rows.image.data(), &parts.texel(0, first)[0]);
    });
    EXPECT_GT(bands, 3);
    EXPECT_EQ(next, 90);
    EXPECT_LE(largest_difference(whole, parts), 1e-5);
  }
}

TEST(Horizon, IsTheSameForAnyThreads) {
  const HeightField field = rough_field(100, 60, WrapMode::wrap, 20);
  GenerateOptions options;
  options.threads = 1;
  const FloatImage one = generate(field, options).image;
  options.threads = 3;
  EXPECT_EQ(one.data(), generate(field, options).image.data());
}

TEST(Horizon, IsTheSameWithAnyInstructions) {
  const HeightField field = rough_field(100, 60, WrapMode::wrap, 20);
  const FloatImage best = generate(field, {}).image;
  const std::vector<std::string> all = sweep_instructions();
  for (const std::string& instructions : all) {
    use_sweep_instructions(instructions);
    EXPECT_LE(largest_difference(best, generate(field, {}).image), 1e-4) << instructions;
  }
  use_sweep_instructions(all.front());
}

TEST(Horizon, StaysFiniteOnWildHeights) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> height(-1e4, 1e4);
  for (const WrapMode beyond : {WrapMode::wrap, WrapMode::mirror, WrapMode::none}) {
    for (const auto& [width, height_] : {std::pair(1, 1), {1, 40}, {37, 1}, {3, 5}, {65, 31}}) {
      const auto weights =
          generate(field_of(width, height_, beyond, [&](int, int) { return height(random); }), {});
      for (const float weight : weights.image.data()) ASSERT_TRUE(weight >= 0 && weight <= 1);
    }
  }
}

}  // namespace
