// encoding/sg.h - six spherical Gaussians over the upper hemisphere.
#pragma once

#include "base/math.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace rnmbake {

/// Axes of the lobes in tangent space: the normal, and five around it, 65 degrees off: neighbours are 64 to
/// 65 degrees apart.
[[nodiscard]] inline const std::array<Vec3d, 6>& sg_axes() {
  static const std::array<Vec3d, 6> axes = [] {
    std::array<Vec3d, 6> made{Vec3d(0, 0, 1)};
    const double tilt = 65 * pi / 180;
    for (std::size_t i = 0; i < 5; ++i) {
      made[i + 1] = direction_at(tilt, static_cast<double>(i) * 2 * pi / 5);
    }
    return made;
  }();
  return axes;
}

/// Of every lobe exp(sharpness (D . axis - 1)): one half half-way between two neighbours.
[[nodiscard]] inline double sg_sharpness() {
  static const double sharpness = std::log(2.0) / (1 - std::cos(32.5 * pi / 180));
  return sharpness;
}

/// E/pi of a lobe of radiance exp(sharpness (D . axis - 1)) for a normal with this cosine to its axis: Hill's
/// fit, in Pettineo, "SG Series Part 3: Diffuse Lighting From an SG Light Source" (2016). Within 0.008 of the
/// lobe's integral over pi at sg_sharpness().
[[nodiscard]] inline double sg_irradiance(double sharpness, double cosine) {
  constexpr double knee = 0.36;
  const double tail = std::exp(-sharpness), tail2 = tail * tail;
  const double scale = 1 + 2 * tail2 - 1 / sharpness, bias = (tail - tail2) / sharpness - tail2;
  const double width = std::sqrt(1 - scale), slope = knee * cosine, offset = width / (4 * knee);
  const double bent =
      std::abs(slope) <= offset ? (slope + offset) * (slope + offset) / width : std::max(0.0, cosine);
  return (scale * bent + bias) * 2 * (1 - tail2) /
         sharpness;  // the lobe's integral over pi: 2 (1 - e^-2s) / s
}

/// E/pi of each lobe for a unit normal in tangent space; weighed by the lobes' radiance their sum is E/pi.
[[nodiscard]] inline std::array<double, 6> sg_basis(const Vec3d& normal) {
  std::array<double, 6> values{};
  for (std::size_t i = 0; i < 6; ++i) values[i] = sg_irradiance(sg_sharpness(), sg_axes()[i].dot(normal));
  return values;
}

}  // namespace rnmbake
