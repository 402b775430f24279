#include "encoding/packing.h"

#include "encoding/fit/gauss_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rnmbake {
namespace {

/// The lobe of a = 1 and its derivatives by v / a.
LobeValue shape_at(Lobe lobe, const std::array<double, 3>& ratio, const Vec3d& normal) {
  return lobe(1, {ratio[0], ratio[1], ratio[2]}, normal);
}

/// Least squares over the three directions of the basis, in units of the greatest bake; a follows from the
/// flat bake. The quotient a = flat / shape(flat) is infinite at the border of what is allowed, so that
/// steps never cross it.
struct FlatKept {
  Lobe lobe;
  const FourBakes& bakes;
  const std::array<Vec3d, 4>& directions;
  double greatest;

  Residual<3, 3> operator()(const std::array<double, 3>& ratio) const {
    Residual<3, 3> residual;
    const LobeValue flat = shape_at(lobe, ratio, directions[0]);
    if (!(flat.value > 0)) {
      residual.values.fill(std::numeric_limits<double>::infinity());
      return residual;
    }
    const double a = bakes[0] / greatest / flat.value;
    for (std::size_t k = 0; k < 3; ++k) {
      const LobeValue value = shape_at(lobe, ratio, directions[k + 1]);
      residual.values[k] = a * value.value - bakes[k + 1] / greatest;
      const Vec3d slope = (value.by_v - flat.by_v * (value.value / flat.value)) * a;
      residual.jacobian[k] = {slope.x, slope.y, slope.z};
    }
    return residual;
  }
};

std::array<double, 3> clamped(const Vec3d& v, double most) {
  return {std::clamp(v.x, -most, most), std::clamp(v.y, -most, most), std::clamp(v.z, -most, most)};
}

/// The best of the fits that start at the free fit, drawn in, at the linear interpolation's direction, and
/// at none.
Vec3d ratio_within(const FlatKept& model, const FourNumbers& free_fit, double range) {
  const Bounds<3> bounds{{-range, -range, -range}, {range, range, range}};
  const double length = free_fit.v.length();
  const Vec3d towards = length > 0 ? free_fit.v / length : Vec3d(0);
  Minimum<3> best{{0, 0, 0}, std::numeric_limits<double>::infinity()};
  for (const double start : {range, 0.5, 0.0}) {
    const auto found = damped_gauss_newton(model, clamped(towards * start, range), bounds);
    if (found.cost < best.cost) best = found;
  }
  return {best.at[0], best.at[1], best.at[2]};
}

double rounded(double t, int bits) {
  if (bits == 0) return t;
  const double steps = std::ldexp(1.0, bits) - 1;
  return std::round(t * steps) / steps;
}

}  // namespace

bool is_out_of_range(const FourNumbers& free_fit, double range) {
  const Vec3d& v = free_fit.v;
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) > range * free_fit.a;
}

PackedNumbers packed(Lobe lobe, const FourBakes& bakes, const std::array<Vec3d, 4>& directions,
                     const FourNumbers& free_fit, const Packing& packing) {
  PackedNumbers result;
  if (!(bakes[0] > 0)) return result;
  const auto flat_of = [&](const Vec3d& ratio) { return lobe(1, ratio, directions[0]).value; };
  Vec3d ratio = free_fit.a > 0 ? free_fit.v / free_fit.a : Vec3d(0);
  if (is_out_of_range(free_fit, packing.range) || !(flat_of(ratio) > 0)) {
    const double greatest = *std::ranges::max_element(bakes);
    ratio = ratio_within({lobe, bakes, directions, greatest}, free_fit, packing.range);
  }
  for (int axis = 0; axis < 3; ++axis)
    result.t[axis] = rounded(0.5 + ratio[axis] / (2 * packing.range), packing.bits);
  // Where the flat normal lies so near the lobe's zero that rounding moves it across, a stays as it was.
  const double exact = flat_of(ratio), stored = flat_of(unpacked_ratio(result.t, packing.range));
  result.a = bakes[0] / (stored > exact / 4 ? stored : exact);
  return result;
}

}  // namespace rnmbake
