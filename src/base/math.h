// base/math.h - the vector types that every room shares (Imath's).
#pragma once

#include <algorithm>
#include <cmath>

#include <ImathMatrix.h>
#include <ImathVec.h>

namespace rnmbake {

using Vec2 = Imath::V2f;
using Vec3 = Imath::V3f;
using Vec3d = Imath::V3d;
/// Row-vector convention: p' = p * M, the transpose of how Blender writes a matrix.
using Mat44 = Imath::M44d;

/// `v` at length 1; `v` must not be 0. Faster than Imath's, which guards against lengths near the limits of
/// floats.
[[nodiscard]] inline Vec3 unit(const Vec3& v) {
  return v * (1 / std::sqrt(v.dot(v)));
}

/// Unit vector `tilt` radians off z, `azimuth` radians from x towards y.
[[nodiscard]] inline Vec3d direction_at(double tilt, double azimuth) {
  return {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)};
}

/// The greatest of a colour's three channels.
[[nodiscard]] inline float max_channel(const Vec3& colour) {
  return std::max({colour.x, colour.y, colour.z});
}

/// The mean of the magnitudes of a colour's channels: how strong a light is for those who choose between
/// lights. Never negative, so that light of negative colours is still chosen.
[[nodiscard]] inline float mean_magnitude(const Vec3& colour) {
  return (std::abs(colour.x) + std::abs(colour.y) + std::abs(colour.z)) / 3;
}

inline constexpr double pi = 3.14159265358979323846;

}  // namespace rnmbake
