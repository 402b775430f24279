// tests/support/chance.h - how many of independent trials may succeed before chance no longer explains it.
#pragma once

#include <cmath>

namespace rnmbake {

/// Tests fail where chance alone would do so once in a million runs with other seeds.
inline constexpr double significance = 1e-6;

/// P(X <= count) of X successes in `trials` that each succeed with `probability`, 0 < probability < 1.
inline double binomial_at_most(int count, int trials, double probability) {
  double sum = 0;
  for (int k = 0; k <= count && k <= trials; ++k) {
    sum += std::exp(std::lgamma(trials + 1.0) - std::lgamma(k + 1.0) - std::lgamma(trials - k + 1.0) +
                    k * std::log(probability) + (trials - k) * std::log1p(-probability));
  }
  return sum;
}

/// P(|T| <= t) of Student's t: the finite sums of Abramowitz and Stegun, 26.7.3 and 26.7.4.
inline double student_within(double t, int freedom) {
  constexpr double half_turn = 3.14159265358979323846;
  const double angle = std::atan(t / std::sqrt(freedom)), cosine = std::cos(angle);
  const bool odd = freedom % 2 == 1;
  double sum = 0, term = odd ? cosine : 1;
  for (int k = odd ? 1 : 0; k <= freedom - 2; k += 2) {
    sum += term;
    term *= cosine * cosine * (k + 1.0) / (k + 2.0);
  }
  return odd ? (angle + std::sin(angle) * sum) * 2 / half_turn : std::sin(angle) * sum;
}

/// The successes that chance explains, both ends included.
struct CountBounds {
  int fewest = 0, most = 0;
};

/// Fewer than `fewest` successes, and likewise more than `most`, have a probability of at most
/// `false_alarm` / 2 each where a trial succeeds with a probability from `least` to `greatest`. Trials have
/// to be independent: of texels that share paths only one counts.
inline CountBounds count_bounds(int trials, double least, double greatest,
                                double false_alarm = significance) {
  CountBounds bounds{0, trials};
  while (binomial_at_most(bounds.fewest, trials, least) <= false_alarm / 2) ++bounds.fewest;
  // More than m successes are at most trials - m - 1 failures.
  int failures = 0;
  while (binomial_at_most(failures, trials, 1 - greatest) <= false_alarm / 2) ++failures;
  bounds.most = trials - failures;
  return bounds;
}

inline CountBounds count_bounds(int trials, double probability) {
  return count_bounds(trials, probability, probability);
}

}  // namespace rnmbake
