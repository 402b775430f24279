// image/metrics.h - how far one picture is from another, with the noise taken out and 95 % intervals.
#pragma once

#include "image/float_image.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace rnmbake {

/// An estimate with its two-sided 95 % confidence interval; infinite where there is too little to tell.
struct Statistic {
  double value = 0, low95 = 0, high95 = 0;
};

/// One side of a comparison: a picture and what is known of its noise. With a `second`, an independent bake
/// of the same (another seed), the value of a texel is the mean of the two and its noise half their
/// difference; `standard_error` (same size and channels) is used where there is no second.
struct ComparedPicture {
  const FloatImage* value = nullptr;
  const FloatImage* second = nullptr;
  const FloatImage* standard_error = nullptr;
  double paths = 0;  // for each texel, over both halves; 0: not known

  [[nodiscard]] bool knows_noise() const { return second != nullptr || standard_error != nullptr; }
};

/// Which texels count: those where every mask given is at least `least` (one channel, size of the pictures).
struct CountedWhere {
  const FloatImage* mask = nullptr;
  float least = 0.5F;
};
[[nodiscard]] bool counts(const std::vector<CountedWhere>& counted, std::size_t texel);

/// In the pictures' units. An error is candidate minus reference; every channel counts alike.
struct PictureMetrics {
  std::size_t texels = 0;      // that count: inside every mask, finite on both sides
  std::size_t non_finite = 0;  // inside every mask, but NaN or infinite somewhere: left out
  double reference_mean = 0;
  Statistic bias, relative_bias;     // relative: to reference_mean
  Statistic rmse, relative_rmse;     // known noise removed; 0 where the noise explains all of it
  double p95 = 0, p99 = 0, max = 0;  // of a texel's error (RMS of its channels), noise and all
  int max_x = 0, max_y = 0;          // the texel of `max`, from the top left
  std::size_t max_picture = 0;       // which of the pictures it is in, in the order of add()
  double candidate_noise = 0, reference_noise = 0;  // RMS standard error; 0 where it is not known
  bool candidate_noise_known = false, reference_noise_known = false;  // for every picture
  bool too_noisy = false;  // a few texels make the mean's noise: its interval is wide, its value says little
};

/// Textures (of one object, or all of a scene) compared as one. The intervals come from a jackknife over
/// tiles of at most 8x8 texels, smaller where a picture would have fewer than 16: right where neighbours
/// within a tile are correlated, as after filtering or with patterns of samples. The squared error is
/// unbiased: the square of the difference, less the noise's variance on either side; for two halves a1, a2
/// against r that is (a1 - r)(a2 - r). Percentiles and maximum cannot be freed from noise.
///
/// Light that few paths find is missing from most estimates of it, and so is its noise: the intervals of
/// means reach as far as if one path more had found it, the one that left the most noise (after Fay and
/// Feuer, "Confidence intervals for directly standardized rates: a method based on the gamma distribution",
/// 1997). Where the two sides' paths are known, a path that one side found counts for the other one with its
/// weight there.
class PictureComparison {
 public:
  /// All pictures and masks have one size. Throws Error(invalid_input) where they do not.
  void add(const ComparedPicture& candidate, const ComparedPicture& reference,
           const std::vector<CountedWhere>& counted);

  /// Adds what another comparison saw, its pictures after this one's.
  void add(const PictureComparison& other);

  [[nodiscard]] PictureMetrics metrics() const;

 private:
  /// Sums over the texels of a tile and all their channels.
  struct Tile {
    double values = 0, error = 0, squared_error = 0, reference = 0;
    Tile& operator+=(const Tile& other);
    Tile operator-(const Tile& other) const;
  };
  struct Worst {
    double error = -1;
    int x = 0, y = 0;
    std::size_t picture = 0;
  };

  /// The most that the noise of a single texel may add to the sum of errors, or take from it: one rare path.
  struct RarePath {
    double up = 0, down = 0;
    double squared = 0;  // to the sum of squared errors: where noise meets noise, a few texels make it
    void take(const RarePath& other);
  };
  /// The largest noise of a texel on either side, summed over its channels.
  struct LargestNoise {
    double candidate = 0, reference = 0, squared_error = 0;
  };

  void add_texel(const ComparedPicture& candidate, const ComparedPicture& reference, int x, int y, Tile& tile,
                 LargestNoise& largest);
  /// An estimate with half the width of its interval, rare paths not counted.
  struct Reach {
    double value = 0, standard_error = 0, quantile = 0;
  };
  [[nodiscard]] Reach jackknife(const Tile& sum, const std::function<double(const Tile&)>& estimate) const;
  /// `down` and `up`: what a rare path may do to the estimate.
  [[nodiscard]] static Statistic with_rare_path(const Reach& reach, double down, double up);

  std::vector<Tile> tiles_;
  std::vector<float> errors_;  // one for each texel
  Worst worst_;
  RarePath rare_;
  std::size_t pictures_ = 0, non_finite_ = 0;
  double candidate_variance_ = 0, reference_variance_ = 0;  // summed over values
  bool candidate_noise_known_ = true, reference_noise_known_ = true;
};

/// A value of a picture, the mean where there are two halves, and the variance of its noise (0: not known).
struct NoisyValue {
  double value = 0, variance = 0;
};
[[nodiscard]] NoisyValue noisy_value(const ComparedPicture& picture, std::size_t index);

}  // namespace rnmbake
