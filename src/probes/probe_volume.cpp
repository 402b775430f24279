#include "probes/probe_volume.h"

namespace rnmbake {

Vec3d ProbeGrid::coordinates(const Vec3d& world) const {
  // Cramer's rule.
  const Vec3d from = world - first, yz = steps[1].cross(steps[2]), zx = steps[2].cross(steps[0]),
              xy = steps[0].cross(steps[1]);
  const double volume = steps[0].dot(yz);
  return Vec3d(from.dot(yz), from.dot(zx), from.dot(xy)) / volume;
}

}  // namespace rnmbake
