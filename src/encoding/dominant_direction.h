// encoding/dominant_direction.h - splits a texel's irradiance into a dominant direction and an ambient part.
#pragma once

#include "base/math.h"
#include "encoding/rnm.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace rnmbake {

/// Irradiance linear in the normal (SH bands 0 and 1): E(n)/pi = ambient + gradient . n, for each of R, G, B.
struct LinearLight {
  std::array<float, 3> ambient{};
  std::array<Vec3, 3> gradient{Vec3(0), Vec3(0), Vec3(0)};

  [[nodiscard]] float at(std::size_t colour, const Vec3& n) const {
    return ambient[colour] + gradient[colour].dot(n);
  }
};

/// Interpolates the four baked values at (0, 0, 1) and at the three directions of the Half-Life 2 basis,
/// which determine such a function. A lone sun above the horizon of all three gives ambient 0, gradient
/// towards it.
[[nodiscard]] inline LinearLight fit_linear(const std::array<float, 3>& flat,
                                            const std::array<std::array<float, 3>, 3>& rnm) {
  const auto basis = rnm_basis();
  LinearLight light;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3 sum = basis[0] * rnm[0][c] + basis[1] * rnm[1][c] + basis[2] * rnm[2][c];
    const float mean = (rnm[0][c] + rnm[1][c] + rnm[2][c]) / 3;
    const float up = (flat[c] - mean) / (1 - basis[0].z);
    light.gradient[c] = {sum.x, sum.y, up};
    light.ambient[c] = flat[c] - up;
  }
  return light;
}

/// Unit gradient of the luminance (Rec. 709) of the irradiance. One that points below the surface, as the fit
/// has for suns near the horizon, is raised to the horizon. Nothing where the gradient is all but zero.
[[nodiscard]] inline std::optional<Vec3> dominant_direction(const LinearLight& light) {
  const auto luminance = [](const auto& rgb) {
    return rgb[0] * 0.2126F + rgb[1] * 0.7152F + rgb[2] * 0.0722F;
  };
  Vec3 towards = luminance(light.gradient);
  towards.z = std::max(towards.z, 0.0F);
  const float length = towards.length(), least = 1e-4F * std::abs(luminance(light.ambient));
  if (!(length > least) || length == 0) return std::nullopt;
  return towards / length;
}

/// E/pi where only the share `left` of the light from `direction` arrives. The directional part of a channel
/// is the component of its gradient along `direction`, clamped to [0, E]; the rest stays.
[[nodiscard]] inline float shadowed(const LinearLight& light, std::size_t colour, const Vec3& direction,
                                    const Vec3& normal, float left) {
  const float all = std::max(0.0F, light.at(colour, normal));
  const float along = std::max(0.0F, light.gradient[colour].dot(direction)) * direction.dot(normal);
  return all - (1 - left) * std::clamp(along, 0.0F, all);
}

}  // namespace rnmbake
