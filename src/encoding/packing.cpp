#include "encoding/packing.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

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
  if (is_out_of_range(free_fit, packing.range) || !(flat_of(ratio) > 0))
    ratio = flat_kept(lobe, bakes, directions, free_fit.v, packing.range);
  for (int axis = 0; axis < 3; ++axis)
    result.t[axis] = rounded(0.5 + ratio[axis] / (2 * packing.range), packing.bits);
  // Where the flat normal lies so near the lobe's zero that rounding moves it across, a stays as it was.
  const double exact = flat_of(ratio), stored = flat_of(unpacked_ratio(result.t, packing.range));
  result.a = bakes[0] / (stored > exact / 4 ? stored : exact);
  return result;
}

}  // namespace rnmbake
