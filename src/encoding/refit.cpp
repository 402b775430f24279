#include "encoding/refit.h"

#include "encoding/fit/gauss_newton.h"
#include "encoding/geomerics.h"
#include "encoding/linear_light.h"
#include "encoding/rnm.h"
#include "encoding/zh3.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace rnmbake {
namespace {

constexpr double least_a = 1e-6;  // of the greatest bake

/// What is left of the bakes, by the lobe of (a, v) = x.
template <typename LobeFunction>
Residual<4, 4> residual_at(const LobeFunction& lobe, const FourBakes& bakes, const std::array<double, 4>& x) {
  Residual<4, 4> residual;
  for (std::size_t k = 0; k < 4; ++k) {
    const LobeValue value = lobe(x[0], Vec3d(x[1], x[2], x[3]), four_directions()[k]);
    residual.values[k] = value.value - bakes[k];
    residual.jacobian[k] = {value.by_a, value.by_v.x, value.by_v.y, value.by_v.z};
  }
  return residual;
}

/// Cramer's rule by the 2 x 2 minors of the upper and of the lower two rows: one division, no pivots. Not
/// finite where the matrix is singular, and inexact near that, which the next step tells.
std::array<double, 4> solved_four(const std::array<std::array<double, 4>, 4>& m,
                                  const std::array<double, 4>& right) {
  const auto minor = [&](std::size_t row, std::size_t i, std::size_t j) {
    return m[row][i] * m[row + 1][j] - m[row][j] * m[row + 1][i];
  };
  const double s0 = minor(0, 0, 1), s1 = minor(0, 0, 2), s2 = minor(0, 0, 3), s3 = minor(0, 1, 2),
               s4 = minor(0, 1, 3), s5 = minor(0, 2, 3), c0 = minor(2, 0, 1), c1 = minor(2, 0, 2),
               c2 = minor(2, 0, 3), c3 = minor(2, 1, 2), c4 = minor(2, 1, 3), c5 = minor(2, 2, 3);
  const double scale = 1 / (s0 * c5 - s1 * c4 + s2 * c3 + s3 * c2 - s4 * c1 + s5 * c0);
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

/// Newton's steps for the four equations themselves: three or four where the start is near, as most are.
/// Nothing where one does not at least halve what is left.
template <typename LobeFunction>
std::optional<FourNumbers> newton(const LobeFunction& lobe, const FourBakes& bakes,
                                  const FourNumbers& start) {
  constexpr int most_steps = 8;
  constexpr double arrived = 1e-16;  // a sum of squares: a sixth of what a float can tell apart
  std::array<double, 4> x{start.a, start.v.x, start.v.y, start.v.z};
  double left = std::numeric_limits<double>::max();
  for (int step = 0; step < most_steps; ++step) {
    const Residual<4, 4> now = residual_at(lobe, bakes, x);
    const double cost = now.cost();
    if (cost <= arrived) return FourNumbers{x[0], {x[1], x[2], x[3]}, true};
    if (!(cost < left / 4)) return std::nullopt;
    left = cost;
    const std::array<double, 4> move = solved_four(now.jacobian, now.values);
    for (std::size_t i = 0; i < 4; ++i) x[i] -= move[i];
    if (!(x[0] > least_a)) return std::nullopt;
  }
  return std::nullopt;
}

/// The same with the lobe's own code in the loop where it is one of ours.
std::optional<FourNumbers> newton_of(Lobe lobe, const FourBakes& bakes, const FourNumbers& start) {
  const auto zh3 = [](double a, const Vec3d& v, const Vec3d& n) { return zh3_lobe(a, v, n); };
  const auto geomerics = [](double a, const Vec3d& v, const Vec3d& n) { return geomerics_lobe(a, v, n); };
  if (lobe == zh3_lobe) return newton(zh3, bakes, start);
  if (lobe == geomerics_lobe) return newton(geomerics, bakes, start);
  return newton(lobe, bakes, start);
}

FourNumbers numbers_from(Lobe lobe, const FourBakes& bakes, const FourNumbers& start) {
  if (const auto found = newton_of(lobe, bakes, start)) return *found;
  const auto model = [&](const std::array<double, 4>& x) { return residual_at(lobe, bakes, x); };
  constexpr double far = std::numeric_limits<double>::max();
  const Bounds<4> bounds{{least_a, -far, -far, -far}, {far, far, far, far}};
  const auto [x, cost] =
      damped_gauss_newton(model, std::array{start.a, start.v.x, start.v.y, start.v.z}, bounds);
  FourNumbers found{x[0], {x[1], x[2], x[3]}, true};
  for (const double error : model(x).values) found.has_converged &= std::abs(error) <= 1e-6;
  return found;
}

double squared_error(Lobe lobe, const FourBakes& bakes, const FourNumbers& numbers) {
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double error = lobe(numbers.a, numbers.v, four_directions()[k]).value - bakes[k];
    sum += error * error;
  }
  return sum;
}

/// Numbers with v along `towards` and |v| = ratio a, linear in the normal, that meet the flat bake.
FourNumbers start_at(double ratio, const Vec3d& towards, double flat) {
  const double a = std::max(std::abs(flat) / (1 + ratio * std::max(0.0, towards.z)), least_a);
  return {a, towards * (ratio * a), true};
}

}  // namespace

const std::array<Vec3d, 4>& four_directions() {
  static const std::array<Vec3d, 4> directions{Vec3d(0, 0, 1), Vec3d(rnm_basis()[0]), Vec3d(rnm_basis()[1]),
                                               Vec3d(rnm_basis()[2])};
  return directions;
}

FourNumbers linear_numbers(const FourBakes& bakes) {
  const auto& [up, b0, b1, b2] = four_directions();
  const auto [a, v] =
      linear_through(bakes[0], std::array{bakes[1], bakes[2], bakes[3]}, std::array{b0, b1, b2});
  return {a, v, true};
}

FourNumbers nearest_numbers(Lobe lobe, const FourBakes& bakes) {
  double scale = 0;
  for (const double bake : bakes) scale = std::max(scale, std::abs(bake));
  if (scale == 0) return {};
  FourBakes scaled = bakes;
  for (double& bake : scaled) bake /= scale;
  const FourNumbers linear = linear_numbers(scaled);
  const double length = linear.v.length();
  const Vec3d towards = length > 0 ? linear.v / length : Vec3d(0, 0, 1);
  // No light has harmonics with |v| > 2a, and from there the steps rarely find back.
  const bool is_likely = linear.a > least_a && length < 2 * linear.a;
  FourNumbers best = numbers_from(lobe, scaled, is_likely ? linear : start_at(1.5, towards, scaled[0]));
  for (const double ratio : {1.0, 0.5, 1.9}) {
    if (best.has_converged) break;
    const FourNumbers other = numbers_from(lobe, scaled, start_at(ratio, towards, scaled[0]));
    if (squared_error(lobe, scaled, other) < squared_error(lobe, scaled, best)) best = other;
  }
  return {best.a * scale, best.v * scale, best.has_converged};
}

FourNumbers refit(Lobe lobe, const FourBakes& bakes) {
  FourNumbers nearest = nearest_numbers(lobe, bakes);
  if (nearest.has_converged || !(bakes[0] > 0)) return nearest;
  const Vec3d ratio = flat_kept(lobe, bakes, four_directions(), nearest.v, 2);
  const double a = bakes[0] / lobe(1, ratio, four_directions()[0]).value;
  return {a, ratio * a, false};
}

}  // namespace rnmbake
