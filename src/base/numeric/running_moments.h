// base/numeric/running_moments.h - mean and spread of values that come one at a time, without cancellation.
#pragma once

namespace rnmbake {

/// Welford, "Note on a Method for Calculating Corrected Sums of Squares and Products" (1962). The caller
/// counts, since many moments may share one count. T: a floating-point number or a vector of them.
template <typename T>
struct RunningMoments {
  T mean = T(0), squares = T(0);  // squares: summed squared deviations from the mean

  /// `count`: of the values added, this one included.
  template <typename Scalar>
  void add(const T& value, Scalar count) {
    const T deviation = value - mean;
    mean += deviation / count;
    squares += deviation * (value - mean);
  }
};

}  // namespace rnmbake
