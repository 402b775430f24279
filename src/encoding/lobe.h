// encoding/lobe.h - E/pi as a function of the normal that four numbers determine, and its gradient.
#pragma once

#include "base/math.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {

/// E/pi of one colour for a unit normal, and its derivatives by the four numbers.
template <typename Number, typename Vector>
struct LobeOf {
  Number value, by_a;
  Vector by_v;
};
using LobeValue = LobeOf<double, Vec3d>;

/// A decoder of a (mean over all directions) and v (towards the light): sh2_lobe, zh3_lobe, geomerics_lobe.
/// Of degree 1: twice a and v give twice the value. Turns with v and the normal, whatever their space.
using Lobe = LobeValue (*)(double a, const Vec3d& v, const Vec3d& normal);

/// A bound of such a decoder, which depends on the normal by its cosine to v alone: no value at a cosine of
/// at least `least_cosine` is below it. `length`: |v|. sh2_least, zh3_least, geomerics_least.
using LeastOfLobe = double (*)(double a, double length, double least_cosine);

/// The least cosine between v, which is not 0, and the normals tilted up to 60 degrees off `up`.
[[nodiscard]] inline double least_cosine_about(const Vec3d& up, const Vec3d& v, double length) {
  const double cosine = std::clamp(up.dot(v) / length, -1.0, 1.0);
  constexpr double sine_60 = 0.86602540378443865;
  return cosine > -0.5 ? cosine / 2 - sine_60 * std::sqrt(1 - cosine * cosine) : -1;
}

}  // namespace rnmbake
