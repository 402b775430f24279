// encoding/fit/least_squares.h - coefficients of functions from their values at many directions.
#pragma once

#include "base/math.h"

#include <cstddef>
#include <span>
#include <vector>

namespace rnmbake {

/// The matrix that turns values into the coefficients of least squared error, computed once for a set of
/// directions.
class LeastSquares {
 public:
  /// `values[k][i]`: function i at direction k, all rows of one length. The sum of functions meets the value
  /// at direction `kept` exactly; the squared errors at the others are the least then.
  LeastSquares(const std::vector<std::vector<double>>& values, std::size_t kept);

  /// Greatest over least singular value of `values`: how much noise of the directions may grow. Infinite
  /// where the directions do not determine the coefficients.
  [[nodiscard]] double condition() const { return condition_; }

  /// One value for each direction, one coefficient for each function; colours apart.
  void solve(std::span<const Vec3> values, std::span<Vec3> coefficients) const;

 private:
  std::size_t directions_ = 0;
  std::vector<double> matrix_;  // [functions x directions]
  double condition_ = 0;
};

}  // namespace rnmbake
