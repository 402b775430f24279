// encoding/dominant_direction.h - splits a texel's irradiance into a dominant direction and an ambient part.
#pragma once

#include "base/math.h"
#include "encoding/linear_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace rnmbake {

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
