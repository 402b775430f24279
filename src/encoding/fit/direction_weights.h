// encoding/fit/direction_weights.h - weights of a set's lightmaps whose sum is the light that a shadowed
// texel receives.
//
// A lightmap of direction B_i holds LM_i = integral of f_i(D) L(D) dD / pi over the upper hemisphere, with
// f_i(D) = max(0, D . B_i). A texel that sees the share V(D) of the sky and turns its normal to n receives
//     E = integral of r(D) L(D) dD / pi,   r(D) = V(D) max(0, D . n),
// its response. Weights s answer for all light L alike, far lamps first of all, where they bring
// sum of s_i f_i(D) as near to r(D) as they can: least squares over the hemisphere,
//     G s = t,   G_ij = integral of f_i f_j dD,   t_i = integral of r f_i dD.
// The lobes overlap, so the shares of visibility within each, which serve three orthogonal axes, would count
// the light of overlaps more than once: G^-1 takes out what other lobes hold already, and leaves to each
// direction the part of the hemisphere that it alone stands for.
//
// Of all weights, only those are looked at whose light of an even sky is exact, c . s = e with
// c_i = integral of f_i dD and e = integral of r dD: ambient occlusion is kept, and where the lobes cannot
// follow a shadow's edge no light is gained or lost on average. With A = G^-1 the least squares then are
//     s = A t + A c (e - c . A t) / (c . A c).
// An open, flat texel has r = f_flat: where the set holds `flat`, its weight is 1 and the others are 0 under
// any light; in other sets the even sky is exact.
//
// Integrals are sums over `directions`, the same for G and t, so that what holds above holds of the sums for
// any number of them.
#pragma once

#include "base/math.h"

#include <cstddef>
#include <span>
#include <vector>

namespace rnmbake {

/// free: the least squares above, some of them below 0. positive: the least among weights of at least 0
/// (Lawson and Hanson 1974), then scaled to the light of an even sky.
enum class WeightSign { free, positive };

class DirectionWeights {
 public:
  /// `axes`: the set's, unit length. `directions`: spread evenly over the upper hemisphere, more of them than
  /// axes. Axes that do not determine the weights (two alike) share them evenly.
  DirectionWeights(const std::vector<Vec3>& axes, const std::vector<Vec3>& directions);

  [[nodiscard]] std::size_t count() const { return sums_.size(); }

  /// `response`: r in each of the directions. One weight for each axis.
  void solve(std::span<const float> response, WeightSign sign, std::span<float> weights) const;

 private:
  [[nodiscard]] std::vector<double> free_of(const std::vector<double>& t, double sky) const;
  [[nodiscard]] std::vector<double> positive_of(const std::vector<double>& t, double sky) const;

  std::vector<float> lobes_;     // f_i in direction k: [axes x directions]
  std::vector<double> gram_;     // G, [axes x axes]
  std::vector<double> inverse_;  // A, the same
  std::vector<double> sums_;     // c
  std::vector<double> sky_;      // A c / (c . A c)
};

}  // namespace rnmbake
