// encoding/fit/gauss_newton-inl.h - damped Gauss-Newton steps within bounds, of problems side by side.
//
// Compiled as encoding/lanes-inl.h.
#if defined(RNMBAKE_ENCODING_GAUSS_NEWTON_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RNMBAKE_ENCODING_GAUSS_NEWTON_INL_H
#undef RNMBAKE_ENCODING_GAUSS_NEWTON_INL_H
#else
#define RNMBAKE_ENCODING_GAUSS_NEWTON_INL_H
#endif

#include "encoding/lanes-inl.h"

#include <array>
#include <cstddef>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace rnmbake::HWY_NAMESPACE {

/// What a model of N unknowns misses in each of N values, and by how much each unknown moves it.
template <std::size_t N>
struct LaneResidual {
  std::array<Lanes, N> values;
  std::array<std::array<Lanes, N>, N> jacobian;

  [[nodiscard]] HWY_INLINE Lanes cost() const {
    Lanes sum = 0.0;
    for (const Lanes& value : values) sum = sum + value * value;
    return sum;
  }
};

template <std::size_t N>
struct LaneMinimum {
  std::array<Lanes, N> at;
  Lanes cost;
};

/// Solves the symmetric, positive system by Gauss' elimination, which needs no pivots for these.
template <std::size_t N>
HWY_INLINE std::array<Lanes, N> solved_positive(std::array<std::array<Lanes, N>, N> rows,
                                                std::array<Lanes, N> right) {
  for (std::size_t i = 0; i < N; ++i) {
    const Lanes scale = 1.0 / rows[i][i];
    for (std::size_t k = i + 1; k < N; ++k) {
      const Lanes share = rows[k][i] * scale;
      for (std::size_t j = i + 1; j < N; ++j) rows[k][j] = rows[k][j] - share * rows[i][j];
      right[k] = right[k] - share * right[i];
    }
  }
  for (std::size_t i = N; i-- > 0;) {
    for (std::size_t j = i + 1; j < N; ++j) right[i] = right[i] - rows[i][j] * right[j];
    right[i] = right[i] / rows[i][i];
  }
  return right;
}

/// One step downhill within |x_i| <= bound; unknowns that the bound holds back stay where they are.
template <std::size_t N>
HWY_INLINE std::array<Lanes, N> damped_step(const LaneResidual<N>& now, const std::array<Lanes, N>& x,
                                            Lanes bound, Lanes damping) {
  std::array<std::array<Lanes, N>, N> normal;
  std::array<Lanes, N> downhill, is_free;
  for (std::size_t i = 0; i < N; ++i) {
    downhill[i] = 0.0;
    for (std::size_t k = 0; k < N; ++k) downhill[i] = downhill[i] - now.jacobian[k][i] * now.values[k];
    const Lanes room = select(downhill[i] > 0.0, bound - x[i], bound + x[i]);
    is_free[i] = select(room > 0.0, 1.0, 0.0);
  }
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j) {
      Lanes sum = 0.0;
      for (std::size_t k = 0; k < N; ++k) sum = sum + now.jacobian[k][i] * now.jacobian[k][j];
      normal[i][j] = sum * is_free[i] * is_free[j];
    }
    normal[i][i] = select(is_free[i] > 0.0, normal[i][i] + damping * (normal[i][i] + 1e-9), 1.0);
    downhill[i] = downhill[i] * is_free[i];
  }
  return solved_positive(normal, downhill);
}

/// damped_gauss_newton() (encoding/fit/gauss_newton.h) of each lane for itself, within |x_i| <= bound: the
/// same steps, and the same ends.
template <typename Model, std::size_t N>
HWY_INLINE LaneMinimum<N> damped_gauss_newton(const Model& model, std::array<Lanes, N> x, Lanes bound) {
  constexpr int most_steps = 100;
  constexpr double still = 1e-13, at_end = std::numeric_limits<double>::infinity();
  LaneResidual<N> now = model(x);
  Lanes cost = now.cost(), damping = select(cost < at_end, 1e-3, at_end);
  for (int step = 0; step < most_steps; ++step) {
    damping = select(cost > 1e-20, damping, at_end);
    const auto goes_on = damping < 1e9;
    if (!any(goes_on)) break;
    const std::array<Lanes, N> move = damped_step(now, x, bound, damping);
    std::array<Lanes, N> trial;
    for (std::size_t i = 0; i < N; ++i) trial[i] = min(max(x[i] + move[i], -bound), bound);
    const LaneResidual<N> next = model(trial);
    const Lanes next_cost = select(goes_on, next.cost(), at_end);
    const auto is_better = next_cost < cost;
    const Lanes less = select(cost - next_cost > cost * still, max(damping / 10.0, 1e-12), at_end);
    damping = select(is_better, less, damping * 4.0);
    cost = select(is_better, next_cost, cost);
    for (std::size_t i = 0; i < N; ++i) {
      x[i] = select(is_better, trial[i], x[i]);
      now.values[i] = select(is_better, next.values[i], now.values[i]);
      for (std::size_t j = 0; j < N; ++j)
        now.jacobian[i][j] = select(is_better, next.jacobian[i][j], now.jacobian[i][j]);
    }
  }
  return {x, cost};
}

}  // namespace rnmbake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // the guard for each set
