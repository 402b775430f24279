// encoding/refit/newton-inl.h - Newton's steps for four equations, of one colour or of lanes of them.
//
// Compiled as encoding/lanes-inl.h.
#if defined(RNMBAKE_ENCODING_NEWTON_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RNMBAKE_ENCODING_NEWTON_INL_H
#undef RNMBAKE_ENCODING_NEWTON_INL_H
#else
#define RNMBAKE_ENCODING_NEWTON_INL_H
#endif

#include "encoding/lanes-inl.h"

#include <array>
#include <cstddef>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace rnmbake::HWY_NAMESPACE {

// In units of the greatest bake.
constexpr double newton_arrived = 1e-16;  // a sum of squares: a sixth of what a float can tell apart
constexpr double least_a = 1e-6;

/// Lobe of (a, v) = bake, at each of four directions.
template <typename Number, typename Vector>
struct FourEquations {
  std::array<Number, 4> bakes;
  std::array<Vector, 4> directions;
};

template <typename Number>
struct NewtonEnd {
  std::array<Number, 4> x;  // a, v
  Number cost;              // sum of squares that is left; not a number where the steps went astray
};

/// Cramer's rule by the 2 x 2 minors of the upper and of the lower two rows: one division, no pivots. Not
/// finite where the matrix is singular, and inexact near that, which the next step tells.
template <typename Number>
HWY_INLINE std::array<Number, 4> solved_four(const std::array<std::array<Number, 4>, 4>& m,
                                             const std::array<Number, 4>& right) {
  const auto minor = [&](std::size_t row, std::size_t i, std::size_t j)
                         HWY_ATTR { return m[row][i] * m[row + 1][j] - m[row][j] * m[row + 1][i]; };
  const Number s0 = minor(0, 0, 1), s1 = minor(0, 0, 2), s2 = minor(0, 0, 3), s3 = minor(0, 1, 2),
               s4 = minor(0, 1, 3), s5 = minor(0, 2, 3), c0 = minor(2, 0, 1), c1 = minor(2, 0, 2),
               c2 = minor(2, 0, 3), c3 = minor(2, 1, 2), c4 = minor(2, 1, 3), c5 = minor(2, 2, 3);
  const Number scale = 1.0 / (s0 * c5 - s1 * c4 + s2 * c3 + s3 * c2 - s4 * c1 + s5 * c0);
  const auto& [r0, r1, r2, r3] = right;
  return {scale * ((m[1][1] * c5 - m[1][2] * c4 + m[1][3] * c3) * r0 -
                   (m[0][1] * c5 - m[0][2] * c4 + m[0][3] * c3) * r1 +
                   (m[3][1] * s5 - m[3][2] * s4 + m[3][3] * s3) * r2 -
                   (m[2][1] * s5 - m[2][2] * s4 + m[2][3] * s3) * r3),
          scale * (-(m[1][0] * c5 - m[1][2] * c2 + m[1][3] * c1) * r0 +
                   (m[0][0] * c5 - m[0][2] * c2 + m[0][3] * c1) * r1 -
                   (m[3][0] * s5 - m[3][2] * s2 + m[3][3] * s1) * r2 +
                   (m[2][0] * s5 - m[2][2] * s2 + m[2][3] * s1) * r3),
          scale * ((m[1][0] * c4 - m[1][1] * c2 + m[1][3] * c0) * r0 -
                   (m[0][0] * c4 - m[0][1] * c2 + m[0][3] * c0) * r1 +
                   (m[3][0] * s4 - m[3][1] * s2 + m[3][3] * s0) * r2 -
                   (m[2][0] * s4 - m[2][1] * s2 + m[2][3] * s0) * r3),
          scale * (-(m[1][0] * c3 - m[1][1] * c1 + m[1][2] * c0) * r0 +
                   (m[0][0] * c3 - m[0][1] * c1 + m[0][2] * c0) * r1 -
                   (m[3][0] * s3 - m[3][1] * s1 + m[3][2] * s0) * r2 +
                   (m[2][0] * s3 - m[2][1] * s1 + m[2][2] * s0) * r3)};
}

/// Newton's steps for the equations, each number for itself: three or four where the start is near, as most
/// are. Those that do not at least halve what is left, and those to an a of least_a or less, lead astray.
/// Bakes are in units of the greatest.
template <typename Lobe, typename Number, typename Vector>
HWY_INLINE NewtonEnd<Number> newton(const Lobe& lobe, const FourEquations<Number, Vector>& equations,
                                    const std::array<Number, 4>& start) {
  constexpr int most_steps = 8;
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
  NewtonEnd<Number> end{start, std::numeric_limits<double>::max()};
  for (int step = 0; step < most_steps; ++step) {
    std::array<Number, 4> left;
    std::array<std::array<Number, 4>, 4> jacobian;
    Number cost = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto value = lobe(end.x[0], Vector{end.x[1], end.x[2], end.x[3]}, equations.directions[k]);
      left[k] = value.value - equations.bakes[k];
      jacobian[k] = {value.by_a, value.by_v.x, value.by_v.y, value.by_v.z};
      cost = cost + left[k] * left[k];
    }
    const auto goes_on = cost > Number(newton_arrived);  // not for a cost that is not a number
    const auto is_nearer = cost < end.cost / 4.0;
    end.cost = cost;
    if (!any(goes_on)) break;
    const std::array<Number, 4> move = solved_four(jacobian, left);
    Number a = select(is_nearer, end.x[0] - move[0], nowhere);
    a = select(a > Number(least_a), a, nowhere);
    end.x[0] = select(goes_on, a, end.x[0]);
    for (std::size_t i = 1; i < 4; ++i) end.x[i] = select(goes_on, end.x[i] - move[i], end.x[i]);
  }
  return end;
}

}  // namespace rnmbake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // the guard for each set
