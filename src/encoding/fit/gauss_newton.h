// encoding/fit/gauss_newton.h - damped Gauss-Newton steps within bounds, for a handful of unknowns.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace rnmbake {

template <std::size_t Unknowns, std::size_t Residuals>
struct Residual {
  std::array<double, Residuals> values{};
  std::array<std::array<double, Unknowns>, Residuals> jacobian{};

  [[nodiscard]] double cost() const {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return sum;
  }
};

template <std::size_t Unknowns>
struct Bounds {
  std::array<double, Unknowns> least{}, greatest{};
};

template <std::size_t Unknowns>
struct Minimum {
  std::array<double, Unknowns> at{};
  double cost = 0;
};

/// Solves the symmetric, positive system by Gauss' elimination with the greatest pivot.
template <std::size_t N>
[[nodiscard]] std::array<double, N> solved(std::array<std::array<double, N>, N> rows,
                                           std::array<double, N> right) {
  for (std::size_t i = 0; i < N; ++i) {
    std::size_t pivot = i;
    for (std::size_t k = i + 1; k < N; ++k)
      if (std::abs(rows[k][i]) > std::abs(rows[pivot][i])) pivot = k;
    std::swap(rows[i], rows[pivot]);
    std::swap(right[i], right[pivot]);
    for (std::size_t k = i + 1; k < N; ++k) {
      const double share = rows[k][i] / rows[i][i];
      for (std::size_t j = i; j < N; ++j) rows[k][j] -= share * rows[i][j];
      right[k] -= share * right[i];
    }
  }
  for (std::size_t i = N; i-- > 0;) {
    for (std::size_t j = i + 1; j < N; ++j) right[i] -= rows[i][j] * right[j];
    right[i] /= rows[i][i];
  }
  return right;
}

/// One step downhill; unknowns that a bound holds back stay where they are.
template <std::size_t N, std::size_t M>
[[nodiscard]] std::array<double, N> damped_step(const Residual<N, M>& now, const std::array<double, N>& x,
                                                const Bounds<N>& bounds, double damping) {
  std::array<std::array<double, N>, N> normal{};
  std::array<double, N> downhill{};
  for (std::size_t k = 0; k < M; ++k) {
    for (std::size_t i = 0; i < N; ++i) {
      downhill[i] -= now.jacobian[k][i] * now.values[k];
      for (std::size_t j = 0; j < N; ++j) normal[i][j] += now.jacobian[k][i] * now.jacobian[k][j];
    }
  }
  for (std::size_t i = 0; i < N; ++i) {
    const bool is_held =
        (x[i] >= bounds.greatest[i] && downhill[i] > 0) || (x[i] <= bounds.least[i] && downhill[i] < 0);
    if (is_held) {
      for (std::size_t j = 0; j < N; ++j) normal[i][j] = normal[j][i] = 0;
      downhill[i] = 0;
    }
    normal[i][i] += is_held ? 1 : damping * (normal[i][i] + 1e-9);
  }
  return solved(normal, downhill);
}

/// Least sum of squares near `x`: Levenberg (1944), Marquardt (1963). `model(x)` returns a Residual of values
/// about 1; one that is not finite is never stepped on. Best of what was seen, converged or not.
template <typename Model, std::size_t N>
[[nodiscard]] Minimum<N> damped_gauss_newton(const Model& model, std::array<double, N> x,
                                             const Bounds<N>& bounds) {
  constexpr int most_steps = 100;
  constexpr double still = 1e-13;  // of the cost: a least sum above 0 is met to the root of that
  auto now = model(x);
  double cost = now.cost(), damping = 1e-3;
  if (!std::isfinite(cost)) return {x, cost};
  for (int step = 0; step < most_steps && cost > 1e-20 && damping < 1e9; ++step) {
    const auto move = damped_step(now, x, bounds, damping);
    auto trial = x;
    for (std::size_t i = 0; i < N; ++i)
      trial[i] = std::clamp(x[i] + move[i], bounds.least[i], bounds.greatest[i]);
    const auto next = model(trial);
    if (const double trial_cost = next.cost(); trial_cost < cost) {
      const bool is_still = cost - trial_cost <= still * cost;
      x = trial;
      now = next;
      cost = trial_cost;
      if (is_still) break;
      damping = std::max(damping / 10, 1e-12);
    } else {
      damping *= 4;
    }
  }
  return {x, cost};
}

}  // namespace rnmbake
