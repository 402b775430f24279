// ssbump/map/lobes.h - the lobes of a map's channels, and their integrals over the open sky.
#pragma once

#include "base/math.h"
#include "ssbump/map/weights.h"

#include <array>
#include <cstddef>

namespace rnmbake {

/// The lobe max(0, D . axis)^power over the upper hemisphere.
struct Lobe {
  Vec3d axis;
  double power = 1;
};

/// In the order of SsbumpWeights' channels.
[[nodiscard]] std::array<Lobe, SsbumpWeights::channels> ssbump_lobes(double power);

[[nodiscard]] double lobe_value(const Lobe& lobe, const Vec3d& direction);

/// Over one azimuth: the integral of lobe x cos(elevation) from the elevation whose sine is `sine` up to the
/// zenith. `along`: the share of the axis that points there, axis.xy . (cos azimuth, sin azimuth).
[[nodiscard]] double lobe_above(double along, double axis_z, double power, double sine);

/// Over the whole upper hemisphere.
[[nodiscard]] double lobe_whole(const Lobe& lobe);

}  // namespace rnmbake
