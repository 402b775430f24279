// encoding/ambient_cube.h - six colours, one for each side of a cube.
#pragma once

#include "base/math.h"

#include <array>
#include <cstddef>

namespace rnmbake {

/// +x, -x, +y, -y, +z, -z.
using AmbientCube = std::array<Vec3, 6>;

/// Normals of the sides.
[[nodiscard]] inline std::array<Vec3, 6> ambient_cube_axes() {
  return {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)};
}

/// E(n) = sum of n_k^2 C[k, sign n_k]. McTaggart, "Half-Life 2 / Valve Source Shading" (GDC 2004).
[[nodiscard]] inline Vec3 ambient_cube_decode(const AmbientCube& cube, const Vec3& normal) {
  Vec3 light(0);
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t side = 2 * static_cast<std::size_t>(axis) + (normal[axis] < 0 ? 1 : 0);
    light += cube[side] * (normal[axis] * normal[axis]);
  }
  return light;
}

/// The cube whose decode is exact at the six axes; `irradiance_at(normal)` returns E or E/pi as a Vec3.
template <typename IrradianceAt>
[[nodiscard]] AmbientCube ambient_cube_of(const IrradianceAt& irradiance_at) {
  AmbientCube cube;
  for (std::size_t side = 0; side < cube.size(); ++side)
    cube[side] = irradiance_at(ambient_cube_axes()[side]);
  return cube;
}

}  // namespace rnmbake
