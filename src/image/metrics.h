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
};

/// Pictures (of one object, or all of a scene) compared as one. The intervals come from a jackknife over
/// tiles of at most 8x8 texels, smaller where a picture would have fewer than 16: right where neighbours
/// within a tile are correlated, as after filtering or with patterns of samples. The squared error is
/// unbiased: the square of the difference, less the noise's variance on either side; for two halves a1, a2
/// against r that is (a1 - r)(a2 - r). Percentiles and maximum cannot be freed from noise.
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

  void add_texel(const ComparedPicture& candidate, const ComparedPicture& reference, int x, int y,
                 Tile& tile);
  [[nodiscard]] Statistic jackknife(const Tile& sum,
                                    const std::function<double(const Tile&)>& estimate) const;

  std::vector<Tile> tiles_;
  std::vector<float> errors_;  // one for each texel
  Worst worst_;
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
