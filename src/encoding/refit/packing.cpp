#include "encoding/refit/packing.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

double rounded(double t, int bits) {
  if (bits == 0) return t;
  const double steps = std::ldexp(1.0, bits) - 1;
  return std::round(t * steps) / steps;
}

/// The lobe of a = 1 straight up.
double flat_of(Lobe lobe, const Vec3d& ratio, const FreeFit& fit) {
  return lobe(1, ratio, fit.directions[0]).value;
}

PackedNumbers packed_at(Lobe lobe, const Vec3d& ratio, const FreeFit& fit, const Packing& packing) {
  PackedNumbers result;
  for (int axis = 0; axis < 3; ++axis)
    result.t[axis] = rounded(0.5 + ratio[axis] / (2 * packing.range), packing.bits);
  // Where the flat normal lies so near the lobe's zero that rounding moves it across, a stays as it was.
  const double exact = flat_of(lobe, ratio, fit),
               stored = flat_of(lobe, unpacked_ratio(result.t, packing.range), fit);
  result.a = fit.bakes[0] / (stored > exact / 4 ? stored : exact);
  return result;
}

}  // namespace

bool is_out_of_range(const FourNumbers& free_fit, double range) {
  const Vec3d& v = free_fit.v;
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) > range * free_fit.a;
}

std::vector<PackedNumbers> packed(Lobe lobe, std::span<const FreeFit> fits, const Packing& packing) {
  std::vector<Vec3d> ratios(fits.size());
  std::vector<FlatKeptProblem> problems;
  std::vector<std::size_t> places;  // of the problems among the fits
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const FreeFit& fit = fits[i];
    ratios[i] = fit.numbers.a > 0 ? fit.numbers.v / fit.numbers.a : Vec3d(0);
    if (!(fit.bakes[0] > 0)) continue;
    if (is_out_of_range(fit.numbers, packing.range) || !(flat_of(lobe, ratios[i], fit) > 0)) {
      problems.push_back({fit.bakes, fit.directions, fit.numbers.v});
      places.push_back(i);
    }
  }
  const std::vector<Vec3d> kept = flat_kept(lobe, problems, packing.range);
  for (std::size_t k = 0; k < kept.size(); ++k) ratios[places[k]] = kept[k];
  std::vector<PackedNumbers> numbers(fits.size());
  for (std::size_t i = 0; i < fits.size(); ++i)
    if (fits[i].bakes[0] > 0) numbers[i] = packed_at(lobe, ratios[i], fits[i], packing);
  return numbers;
}

}  // namespace rnmbake
