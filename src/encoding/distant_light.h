// encoding/distant_light.h - light from far away, of all directions and colours.
#pragma once

#include "base/math.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace rnmbake {

/// Sources, each of them a unit direction and the E/pi, RGB, that it gives a surface which faces it: for a
/// piece of sky its radiance times its solid angle over pi.
struct DistantLight {
  std::vector<Vec3> directions, powers;

  void add(const Vec3& direction, const Vec3& power) {
    directions.push_back(direction);
    powers.push_back(power);
  }
};

/// E/pi, RGB, for each unit normal, of the sources that stand above a surface which blocks the others; of all
/// sources where `surface` is 0.
[[nodiscard]] inline std::vector<Vec3> irradiance(const DistantLight& light, const Vec3& surface,
                                                  std::span<const Vec3> normals) {
  const bool all = surface.dot(surface) == 0;
  // One array for each coordinate, so that the compiler takes several normals at once.
  std::vector<float> x, y, z, r(normals.size()), g(normals.size()), b(normals.size());
  for (const Vec3& n : normals) {
    x.push_back(n.x);
    y.push_back(n.y);
    z.push_back(n.z);
  }
  for (std::size_t i = 0; i < light.directions.size(); ++i) {
    const Vec3 d = light.directions[i], power = light.powers[i];
    if (!all && d.dot(surface) <= 0) continue;
    for (std::size_t k = 0; k < normals.size(); ++k) {
      const float cosine = std::max(0.0F, d.x * x[k] + d.y * y[k] + d.z * z[k]);
      r[k] += power.x * cosine;
      g[k] += power.y * cosine;
      b[k] += power.z * cosine;
    }
  }
  std::vector<Vec3> found;
  for (std::size_t k = 0; k < normals.size(); ++k) found.emplace_back(r[k], g[k], b[k]);
  return found;
}

}  // namespace rnmbake
