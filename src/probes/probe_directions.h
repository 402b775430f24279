// probes/probe_directions.h - the normals at which a light probe's irradiance is known.
#pragma once

#include "base/math.h"

#include <array>
#include <cstddef>
#include <span>

namespace rnmbake {

inline constexpr std::size_t probe_direction_count = 14;
template <typename T>
using PerProbeDirection = std::array<T, probe_direction_count>;

/// +x, -x, +y, -y, +z, -z, as the sides of an ambient cube (encoding/ambient_cube.h), then the eight corners
/// of the cube, x fastest: (-1, -1, -1), (1, -1, -1), ... over sqrt 3. World space, unit.
[[nodiscard]] const PerProbeDirection<Vec3>& probe_directions();

/// Names in files: "px", "nx", "py", "ny", "pz", "nz", "c0" to "c7".
[[nodiscard]] const PerProbeDirection<const char*>& probe_direction_names();

/// Shares of the sphere, which sum to 1: with them a mean over the directions is exact for polynomials of
/// degree 5. Lebedev, "Quadratures on a sphere" (1976), the rule of 14 points.
[[nodiscard]] const PerProbeDirection<float>& probe_direction_weights();

/// Nine coefficients of radiance (encoding/sh.h) out of E/pi at the directions. Exact for irradiance of bands
/// 0 to 3; what it has in band 4, a sixth of band 2's share of the same light at most, is taken for part of
/// band 2.
[[nodiscard]] std::array<Vec3, 9> harmonics_of(const PerProbeDirection<Vec3>& irradiance);

/// E/pi, RGB, at a unit normal: bands 0 to `order` - 1 of coefficients of radiance; order 1 to 3. May be
/// negative.
[[nodiscard]] Vec3 irradiance_of(std::span<const Vec3> harmonics, const Vec3& normal, int order = 3);

}  // namespace rnmbake
