#include "encoding/flat_kept.h"

#include "encoding/fit/gauss_newton.h"

#include <algorithm>
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

}  // namespace

Vec3d flat_kept(Lobe lobe, const FourBakes& bakes, const std::array<Vec3d, 4>& directions,
                const Vec3d& towards, double range) {
  const FlatKept model{lobe, bakes, directions, *std::ranges::max_element(bakes)};
  const Bounds<3> bounds{{-range, -range, -range}, {range, range, range}};
  const double length = towards.length();
  const Vec3d axis = length > 0 ? towards / length : Vec3d(0);
  Minimum<3> best{{0, 0, 0}, std::numeric_limits<double>::infinity()};
  for (const double start : {range, 0.5, 0.0}) {  // a constant lobe is always allowed
    const auto found = damped_gauss_newton(model, clamped(axis * start, range), bounds);
    if (found.cost < best.cost) best = found;
  }
  return {best.at[0], best.at[1], best.at[2]};
}

}  // namespace rnmbake
