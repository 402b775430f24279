#include "image/metrics.h"

#include "base/error.h"
#include "support/chance.h"
#include "support/pictures.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

constexpr int seed_count = 1000;  // tell intervals an eighth too narrow, or a fifth too wide
const CountBounds right_intervals = count_bounds(seed_count, 0.95);

/// A field of the given deviation that is constant over blocks of 4x4 texels.
FloatImage blocky(int size, double deviation, std::mt19937& random) {
  std::normal_distribution<double> normal(0, deviation);
  FloatImage image(size, size, 3);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      for (int c = 0; c < 3; ++c) {
        const bool first = x % 4 == 0 && y % 4 == 0 && c == 0;
        image.texel(x, y)[c] =
            first ? static_cast<float>(normal(random)) : image.texel(x - x % 4, y - y % 4)[0];
      }
    }
  }
  return image;
}

FloatImage plain(int size, float value, int channels = 3) {
  return filled(size, size, channels, value);
}

void add_noise(FloatImage& image, double deviation, std::mt19937& random) {
  std::normal_distribution<double> normal(0, deviation);
  for (float& value : image.data()) value += static_cast<float>(normal(random));
}

FloatImage sum(const FloatImage& a, const FloatImage& b) {
  FloatImage result = a;
  for (std::size_t i = 0; i < a.data().size(); ++i) result.data()[i] += b.data()[i];
  return result;
}

bool holds(const Statistic& statistic, double truth) {
  return statistic.low95 <= truth && truth <= statistic.high95;
}

PictureMetrics compare(const ComparedPicture& candidate, const ComparedPicture& reference) {
  PictureComparison comparison;
  comparison.add(candidate, reference, {});
  return comparison.metrics();
}

/// How many of the intervals hold the truth. The error is 0.05 + a blocky field of 0.1, and both sides have
/// noise of 0.2 (candidate, two halves of 0.28) and 0.1 (reference, standard error known).
struct Hits {
  int bias = 0, relative_bias = 0, rmse = 0, relative_rmse = 0;
  double mean_square = 0;
};

Hits count_hits(int size) {
  Hits hits;
  const FloatImage truth = plain(size, 2), error = plain(size, 0.1F);
  const double square = 0.05 * 0.05 + 0.1 * 0.1;
  for (int seed = 0; seed < seed_count; ++seed) {
    std::mt19937 random(seed);
    FloatImage first = sum(plain(size, 2.05F), blocky(size, 0.1, random)), second = first, reference = truth;
    add_noise(first, 0.2 * std::sqrt(2), random);
    add_noise(second, 0.2 * std::sqrt(2), random);
    add_noise(reference, 0.1, random);
    const PictureMetrics seen = compare({&first, &second, nullptr}, {&reference, nullptr, &error});
    hits.bias += holds(seen.bias, 0.05);
    hits.relative_bias += holds(seen.relative_bias, 0.025);
    hits.rmse += holds(seen.rmse, std::sqrt(square));
    hits.relative_rmse += holds(seen.relative_rmse, std::sqrt(square) / 2);
    hits.mean_square += seen.rmse.value * seen.rmse.value / seed_count;
  }
  return hits;
}

TEST(Metrics, IntervalsHoldTheTruthAsOftenAsTheySay) {
  for (const int size : {32, 64}) {
    const Hits hits = count_hits(size);
    for (const int count : {hits.bias, hits.relative_bias, hits.rmse, hits.relative_rmse}) {
      EXPECT_GE(count, right_intervals.fewest) << size;
      EXPECT_LE(count, right_intervals.most) << size;
    }
  }
}

TEST(Metrics, NoiseIsTakenOutOfTheSquaredError) {
  const int size = 64;
  const Hits hits = count_hits(size);
  const double square = 0.05 * 0.05 + 0.1 * 0.1;
  // One seed's deviation of the blocky part: 256 squares of normal numbers, plus the cross term.
  const double blocks = size * size / 16.0;
  const double deviation = std::sqrt((2 * 1e-4 + 4 * 0.0025 * 0.01) / blocks / seed_count);
  EXPECT_NEAR(hits.mean_square, square, 4 * deviation);
}

TEST(Metrics, NothingButNoiseLeavesNoError) {
  int with_zero = 0, bias_with_zero = 0;
  for (int seed = 0; seed < seed_count; ++seed) {
    std::mt19937 random(1000 + seed);
    FloatImage first = plain(32, 1), second = first, reference = first;
    add_noise(first, 0.5, random);
    add_noise(second, 0.5, random);
    add_noise(reference, 0.5, random);
    FloatImage error = plain(32, 0.5F);
    const PictureMetrics seen = compare({&first, &second, nullptr}, {&reference, nullptr, &error});
    with_zero += holds(seen.rmse, 0);
    bias_with_zero += holds(seen.bias, 0);
  }
  // An interval wholly below 0 reads [0, 0]: only the half of the misses that lies above is one.
  EXPECT_GE(with_zero, count_bounds(seed_count, 0.975).fewest);
  EXPECT_GE(bias_with_zero, right_intervals.fewest);
  EXPECT_LE(bias_with_zero, right_intervals.most);
}

/// Light that few paths find: what a texel gets of it in all, and how one path's share varies.
struct RareLight {
  double paths = 0;      // that find it, over the whole picture, on the candidate's side
  double log_sigma = 0;  // of a path's share, which is log-normal

  static constexpr double mean = 1;

  /// Adds what `times` as many paths as the candidate's bring to a picture of one channel, the noise's
  /// variance to `variance`.
  void shine(double times, std::mt19937& random, FloatImage& picture, FloatImage* variance) const {
    std::poisson_distribution<int> found(paths * times);
    std::lognormal_distribution<double> share(-log_sigma * log_sigma / 2, log_sigma);
    std::uniform_int_distribution<std::size_t> place(0, picture.texels() - 1);
    const int count = found(random);
    for (int i = 0; i < count; ++i) {
      const std::size_t texel = place(random);
      const auto value = float(mean * double(picture.texels()) / (paths * times) * share(random));
      picture.data()[texel] += value;
      if (variance != nullptr) variance->data()[texel] += value * value;
    }
  }
};

struct RareHits {
  int bias = 0, relative_bias = 0, rmse = 0, too_noisy = 0;
};

/// Two halves that have found the light against a reference of `times` as many paths; the true error is 0.
RareHits count_rare_hits(int size, const RareLight& light, double times, int seeds) {
  RareHits hits;
  constexpr float even = 0.2F;
  for (int seed = 0; seed < seeds; ++seed) {
    std::mt19937 random(seed);
    FloatImage first = plain(size, even, 1), second = first, reference = first, error = plain(size, 0, 1);
    add_noise(first, 0.05, random);
    add_noise(second, 0.05, random);
    light.shine(0.5, random, first, nullptr);
    light.shine(0.5, random, second, nullptr);
    light.shine(times, random, reference, &error);
    for (float& value : error.data()) value = std::sqrt(value);
    const PictureMetrics seen =
        compare({&first, &second, nullptr, 64}, {&reference, nullptr, &error, 64 * times});
    hits.bias += holds(seen.bias, 0);
    hits.relative_bias += holds(seen.relative_bias, 0);
    hits.rmse += holds(seen.rmse, 0);
    hits.too_noisy += seen.too_noisy;
  }
  return hits;
}

/// They may hold it more often than they say: they reach as far as a path that was not found.
TEST(Metrics, IntervalsHoldTheTruthHoweverFewPathsFoundTheLight) {
  constexpr int many = 400;
  const int fewest = count_bounds(many, 0.95).fewest;
  for (const int size : {16, 32}) {
    for (const double times : {2., 8.}) {
      for (const double sigma : {0., 1., 1.5}) {
        for (const double paths : {1., 3., 10., 30., 100., 1000.}) {
          const RareHits hits = count_rare_hits(size, {paths, sigma}, times, many);
          const std::string light = fmt::format(
              "{} paths, log sigma {}, {} times as many in the reference, {}^2", paths, sigma, times, size);
          EXPECT_GE(hits.bias, fewest) << light;
          EXPECT_GE(hits.relative_bias, fewest) << light;
          EXPECT_GE(hits.rmse, fewest) << light;
        }
      }
    }
  }
}

TEST(Metrics, SaysWhereTooFewPathsFoundTheLight) {
  const int few = count_rare_hits(32, {3, 1}, 2, seed_count).too_noisy;
  EXPECT_GE(few, count_bounds(seed_count, 0.9).fewest) << "it is to be said nine times in ten";
  // A path moves the mean by 1/12,000: 36 would have to meet in a texel, where there are ten.
  EXPECT_EQ(count_rare_hits(32, {10000, 0}, 2, 100).too_noisy, 0);
}

TEST(Metrics, AFewNoisyTexelsThatDoNotMoveTheMeanAreNotTooNoisy) {
  FloatImage first = plain(16, 1, 1), second = first;
  first.data()[7] = 1.2F;  // the mean by 0.0004
  const FloatImage reference = plain(16, 1, 1);
  EXPECT_FALSE(compare({&first, &second, nullptr}, {&reference}).too_noisy);
  first.data()[7] = 11;  // by 0.02
  EXPECT_TRUE(compare({&first, &second, nullptr}, {&reference}).too_noisy);
}

TEST(Metrics, WithoutNoiseEverythingIsExact) {
  FloatImage candidate = plain(16, 1.5F);
  const FloatImage reference = plain(16, 2);
  candidate.texel(3, 7)[1] = 5;
  const PictureMetrics seen = compare({&candidate}, {&reference});
  const double values = 16 * 16 * 3;
  const double square = (0.25 * (values - 1) + 9) / values;
  EXPECT_EQ(seen.texels, 256U);
  EXPECT_DOUBLE_EQ(seen.reference_mean, 2);
  EXPECT_NEAR(seen.bias.value, (-0.5 * (values - 1) + 3) / values, 1e-12);
  EXPECT_NEAR(seen.relative_bias.value, seen.bias.value / 2, 1e-12);
  EXPECT_NEAR(seen.rmse.value, std::sqrt(square), 1e-12);
  EXPECT_NEAR(seen.relative_rmse.value, std::sqrt(square) / 2, 1e-12);
  EXPECT_NEAR(seen.p95, 0.5, 1e-7);
  EXPECT_NEAR(seen.p99, 0.5, 1e-7);
  EXPECT_NEAR(seen.max, std::sqrt((9 + 0.5) / 3), 1e-6);
  EXPECT_EQ(seen.max_x, 3);
  EXPECT_EQ(seen.max_y, 7);
  EXPECT_FALSE(seen.candidate_noise_known);
  EXPECT_FALSE(seen.reference_noise_known);
}

TEST(Metrics, PercentilesAreThoseOfTheTexels) {
  FloatImage candidate(100, 1, 1);
  const FloatImage reference(100, 1, 1);
  for (int x = 0; x < 100; ++x) candidate.texel(x, 0)[0] = static_cast<float>(x + 1);
  const PictureMetrics seen = compare({&candidate}, {&reference});
  EXPECT_EQ(seen.p95, 95);
  EXPECT_EQ(seen.p99, 99);
  EXPECT_EQ(seen.max, 100);
}

TEST(Metrics, UncoveredAndNonFiniteTexelsNeverCount) {
  FloatImage candidate = plain(16, 1), reference = plain(16, 1), coverage = plain(16, 1, 1),
             validity = plain(16, 1, 1);
  for (int x = 0; x < 16; ++x) {
    candidate.texel(x, 0)[0] = 1e6F;  // uncovered
    coverage.texel(x, 0)[0] = 0;
    reference.texel(x, 1)[2] = -1e6F;  // unsound
    validity.texel(x, 1)[0] = 0.25F;
  }
  candidate.texel(0, 0)[0] = std::numeric_limits<float>::quiet_NaN();
  candidate.texel(4, 4)[1] = std::numeric_limits<float>::quiet_NaN();
  reference.texel(5, 5)[0] = std::numeric_limits<float>::infinity();
  PictureComparison comparison;
  comparison.add({&candidate}, {&reference}, {{&coverage}, {&validity, 0.5F}, {nullptr}});
  const PictureMetrics seen = comparison.metrics();
  EXPECT_EQ(seen.texels, 16U * 14 - 2);
  EXPECT_EQ(seen.non_finite, 2U);
  EXPECT_EQ(seen.bias.value, 0);
  EXPECT_EQ(seen.rmse.value, 0);
  EXPECT_EQ(seen.max, 0);
}

TEST(Metrics, OfNothingIsNothing) {
  const FloatImage picture = plain(8, 1), nowhere(8, 8, 1);
  PictureComparison comparison;
  comparison.add({&picture}, {&picture}, {{&nowhere}});
  EXPECT_EQ(comparison.metrics().texels, 0U);
  EXPECT_EQ(PictureComparison().metrics().texels, 0U);
}

TEST(Metrics, OneTexelHasNoInterval) {
  const FloatImage candidate = plain(1, 2), reference = plain(1, 1);
  const PictureMetrics seen = compare({&candidate}, {&reference});
  EXPECT_EQ(seen.bias.value, 1);
  EXPECT_TRUE(std::isinf(seen.bias.high95));
}

TEST(Metrics, BlackOnBothSidesIsNoRelativeError) {
  const FloatImage black = plain(16, 0), grey = plain(16, 1);
  EXPECT_EQ(compare({&black}, {&black}).relative_bias.value, 0);
  EXPECT_TRUE(std::isinf(compare({&grey}, {&black}).relative_rmse.value));
}

TEST(Metrics, PicturesOfASceneCountTexelByTexel) {
  const FloatImage small = plain(8, 3), large = plain(16, 1), zero = plain(8, 0), nought = plain(16, 0);
  PictureComparison one, other;
  one.add({&small}, {&zero}, {});
  other.add({&large}, {&nought}, {});
  one.add(other);
  const PictureMetrics seen = one.metrics();
  EXPECT_EQ(seen.texels, 64U + 256);
  EXPECT_NEAR(seen.bias.value, (64 * 3 + 256 * 1) / 320.0, 1e-12);
  EXPECT_EQ(seen.max, 3);
  EXPECT_EQ(seen.max_picture, 0U);
}

TEST(Metrics, SizesMustFit) {
  const FloatImage one = plain(8, 1), other = plain(16, 1);
  PictureComparison comparison;
  EXPECT_THROW(comparison.add({&one}, {&other}, {}), Error);
  EXPECT_THROW(comparison.add({&one, &other}, {&one}, {}), Error);
  EXPECT_THROW(comparison.add({&one}, {&one}, {{&other}}), Error);
}

}  // namespace
}  // namespace rnmbake
