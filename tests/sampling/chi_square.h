// tests/sampling/chi_square.h - whether samples of a map follow the density that stands beside it.
#pragma once

#include "base/math.h"
#include "sampling/splitmix64.h"
#include "support/chance.h"

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace rnmbake {

/// Probability that a chi-square variable with that many degrees of freedom is larger than `value`: the
/// regularised upper incomplete gamma function Q(degrees / 2, value / 2), by its continued fraction (Lentz)
/// right of the mean, by one minus the series left of it.
inline double chi_square_tail(double value, double degrees) {
  const double a = degrees / 2, x = value / 2;
  if (x <= 0) return 1;
  const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int n = 1; term > 1e-16 * sum; ++n) sum += term *= x / (a + n);
    return 1 - scale * sum;
  }
  double b = x + 1 - a, c = 1e300, d = 1 / b, fraction = d;
  for (int n = 1; n < 10000; ++n) {
    const double factor = -n * (n - a);
    b += 2;
    d = 1 / (factor * d + b);
    c = b + factor / c;
    fraction *= c * d;
    if (std::abs(c * d - 1) < 1e-15) break;
  }
  return scale * fraction;
}

/// Pearson's test of counts against probabilities, which may sum to less than 1: what is missing is no bin,
/// so that a sample counted nowhere shows as well. Bins that expect fewer than 5 samples are pooled.
inline double chi_square_tail_of(const std::vector<double>& counts, const std::vector<double>& probabilities,
                                 double samples) {
  double value = 0, pooled_count = 0, pooled_expected = 0;
  int bins = 0;
  const auto add = [&](double count, double expected) {
    value += (count - expected) * (count - expected) / expected;
    ++bins;
  };
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected = samples * probabilities[i];
    if (expected >= 5) {
      add(counts[i], expected);
    } else {
      pooled_count += counts[i];
      pooled_expected += expected;
    }
  }
  if (pooled_expected > 0) {
    add(pooled_count, pooled_expected);
  } else if (pooled_count > 0) {
    return 0;  // samples where the density is 0
  }
  return chi_square_tail(value, bins - 1);
}

/// A grid of equal cells over [low, high], and the integral of a density over each (midpoint rule).
struct Grid {
  Vec2 low, high;
  int columns = 20, rows = 20;
  static constexpr int steps = 24;  // of the midpoint rule within a cell, along each axis

  [[nodiscard]] std::vector<double> integrals(const std::function<double(double, double)>& density) const {
    std::vector<double> cells(std::size_t(columns) * rows);
    const double dx = double(high.x - low.x) / (columns * steps),
                 dy = double(high.y - low.y) / (rows * steps);
    for (int y = 0; y < rows * steps; ++y) {
      for (int x = 0; x < columns * steps; ++x) {
        cells[std::size_t(y / steps) * columns + x / steps] +=
            density(low.x + (x + 0.5) * dx, low.y + (y + 0.5) * dy) * dx * dy;
      }
    }
    return cells;
  }

  /// Tail probability of `samples` points of a map from the unit square into the grid.
  [[nodiscard]] double tail(const std::function<Vec2(const Vec2&)>& map, const std::vector<double>& expected,
                            std::uint64_t seed, int samples = 100000) const {
    SplitMix64 random(seed);
    const auto uniform = [&] { return static_cast<float>(random.next() >> 40) * 0x1p-24F; };
    std::vector<double> counts(expected.size());
    for (int i = 0; i < samples; ++i) {
      const float u = uniform();
      const Vec2 at = map({u, uniform()});
      const int x = static_cast<int>(std::floor((at.x - low.x) / (high.x - low.x) * float(columns)));
      const int y = static_cast<int>(std::floor((at.y - low.y) / (high.y - low.y) * float(rows)));
      const auto within = [](int cell, int count) {
        return cell == count ? count - 1 : cell;
      };  // at the edge
      const int column = within(x, columns), row = within(y, rows);
      if (column < 0 || column >= columns || row < 0 || row >= rows) return 0;
      ++counts[std::size_t(row) * columns + column];
    }
    return chi_square_tail_of(counts, expected, samples);
  }
};

/// Directions by height and azimuth around +z, which keep solid angles.
class DirectionGrid {
 public:
  explicit DirectionGrid(float lowest_height) : grid_{Vec2(lowest_height, -half_turn), Vec2(1, half_turn)} {}

  [[nodiscard]] std::vector<double> integrals(const std::function<double(const Vec3&)>& pdf) const {
    return grid_.integrals([&](double z, double azimuth) {
      const double r = std::sqrt(1 - z * z);
      return pdf(Vec3(Vec3d(r * std::cos(azimuth), r * std::sin(azimuth), z)));
    });
  }
  [[nodiscard]] double tail(const std::function<Vec3(const Vec2&)>& map, const std::vector<double>& expected,
                            std::uint64_t seed) const {
    const auto flat = [&](const Vec2& u) {
      const Vec3 direction = map(u);
      return Vec2(direction.z, std::atan2(direction.y, direction.x));
    };
    return grid_.tail(flat, expected, seed);
  }

 private:
  static constexpr float half_turn = 3.1415928F;  // rounded up: atan2 stays within
  Grid grid_;
};

}  // namespace rnmbake
