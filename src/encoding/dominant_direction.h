// encoding/dominant_direction.h - a lightmap's texel as light from one direction and light from everywhere.
#pragma once

#include "base/math.h"
#include "encoding/rnm.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace rnmbake {

/// E(n)/pi = ambient + gradient . n, for each of R, G, B: an SH-2 fit of irradiance.
struct LinearLight {
  std::array<float, 3> ambient{};
  std::array<Vec3, 3> gradient{Vec3(0), Vec3(0), Vec3(0)};

  [[nodiscard]] float at(std::size_t colour, const Vec3& n) const {
    return ambient[colour] + gradient[colour].dot(n);
  }
};

/// The one such function that has the four baked values at (0, 0, 1) and at the three directions of the
/// Half-Life 2 basis. A lone sun above the horizon of all three comes out as ambient 0, gradient towards it.
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

/// Where most light comes from: the gradient of its luminance (Rec. 709), unit length. One that points below
/// the surface, as the fit makes of suns near the horizon, is raised to the horizon. Nothing where no
/// direction stands out.
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

/// E/pi where only `left` of the light from `direction` arrives. The directional part of a colour is what its
/// gradient has along `direction`, between 0 and all of E; the rest is not touched.
[[nodiscard]] inline float shadowed(const LinearLight& light, std::size_t colour, const Vec3& direction,
                                    const Vec3& normal, float left) {
  const float all = std::max(0.0F, light.at(colour, normal));
  const float along = std::max(0.0F, light.gradient[colour].dot(direction)) * direction.dot(normal);
  return all - (1 - left) * std::clamp(along, 0.0F, all);
}

}  // namespace rnmbake
