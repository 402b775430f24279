#include "encoding/refit/refit.h"

#include "encoding/fit/gauss_newton.h"
#include "encoding/linear_light.h"
#include "encoding/refit/newton-inl.h"
#include "encoding/refit/newton_lanes.h"
#include "encoding/rnm.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace rnmbake {
namespace {

using HWY_NAMESPACE::least_a;

/// What is left of the bakes, by the lobe of (a, v) = x.
Residual<4, 4> residual_at(Lobe lobe, const FourBakes& bakes, const std::array<double, 4>& x) {
  Residual<4, 4> residual;
  for (std::size_t k = 0; k < 4; ++k) {
    const LobeValue value = lobe(x[0], Vec3d(x[1], x[2], x[3]), four_directions()[k]);
    residual.values[k] = value.value - bakes[k];
    residual.jacobian[k] = {value.by_a, value.by_v.x, value.by_v.y, value.by_v.z};
  }
  return residual;
}

FourNumbers numbers_from(Lobe lobe, const FourBakes& bakes, const FourNumbers& start) {
  const HWY_NAMESPACE::FourEquations<double, Vec3d> equations{bakes, four_directions()};
  const auto steps = HWY_NAMESPACE::newton(lobe, equations, {start.a, start.v.x, start.v.y, start.v.z});
  if (steps.cost <= HWY_NAMESPACE::newton_arrived)
    return {steps.x[0], {steps.x[1], steps.x[2], steps.x[3]}, true};
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

struct ScaledBakes {
  FourBakes bakes;
  double scale;  // 0: of bakes that are all 0
};

ScaledBakes in_units_of_the_greatest(FourBakes bakes) {
  double scale = 0;
  for (const double bake : bakes) scale = std::max(scale, std::abs(bake));
  if (scale > 0)
    for (double& bake : bakes) bake /= scale;
  return {bakes, scale};
}

Vec3d direction_of(const Vec3d& v) {
  const double length = v.length();
  return length > 0 ? v / length : Vec3d(0, 0, 1);
}

/// The linear interpolation, where it can be of light: no light has harmonics with |v| > 2a, and from there
/// the steps rarely find back.
FourNumbers likely_start(const FourBakes& scaled) {
  FourNumbers linear = linear_numbers(scaled);
  if (linear.a > least_a && linear.v.length() < 2 * linear.a) return linear;
  return start_at(1.5, direction_of(linear.v), scaled[0]);
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
  const auto [scaled, scale] = in_units_of_the_greatest(bakes);
  if (scale == 0) return {};
  FourNumbers best = numbers_from(lobe, scaled, likely_start(scaled));
  const Vec3d towards = direction_of(linear_numbers(scaled).v);
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
  const FlatKeptProblem problem{bakes, four_directions(), nearest.v};
  const Vec3d ratio = flat_kept(lobe, {&problem, 1}, 2).front();
  const double a = bakes[0] / lobe(1, ratio, four_directions()[0]).value;
  return {a, ratio * a, false};
}

void refit(Lobe lobe, std::span<const FourBakes> bakes, std::span<FourNumbers> numbers) {
  std::vector<FourBakes> scaled(bakes.size());
  std::vector<double> scales(bakes.size());
  for (std::size_t i = 0; i < bakes.size(); ++i) {
    const auto [values, scale] = in_units_of_the_greatest(bakes[i]);
    scaled[i] = values;
    scales[i] = scale;
    numbers[i] = likely_start(values);
  }
  newton_in_lanes(lobe, four_directions(), scaled, numbers);
  for (std::size_t i = 0; i < bakes.size(); ++i) {
    if (numbers[i].has_converged) {
      numbers[i] = {numbers[i].a * scales[i], numbers[i].v * scales[i], true};
    } else {
      numbers[i] = refit(lobe, bakes[i]);
    }
  }
}

}  // namespace rnmbake
