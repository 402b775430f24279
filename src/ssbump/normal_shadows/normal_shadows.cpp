#include "ssbump/normal_shadows/normal_shadows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

constexpr float least_z = 0.02F;  // of normals whose slope is asked for: 88.9 degrees

/// How fast the light's ray rises over the surface of a texel.
float clearance(const FloatImage& normals, int x, int y, const Vec3& light,
                const NormalShadowOptions& options) {
  const Vec3 normal = vec3_at(normals, x, y);
  const float cosine = light.dot(normal);
  return options.true_slopes ? cosine / std::max(normal.z, least_z) : cosine;
}

/// clearance() at a distance from a texel's centre, filtered as a graphics card does: normals are not
/// stretched to unit length. Several times as fast as bilinear_taps(), which starts from a UV.
float clearance_at(const FloatImage& normals, int x, int y, const Vec2& distance, const Vec3& light,
                   const NormalShadowOptions& options) {
  const float whole_x = std::floor(distance.x), whole_y = std::floor(distance.y);
  const float right = distance.x - whole_x, below = distance.y - whole_y;
  const int left_x = x + static_cast<int>(whole_x), top_y = y + static_cast<int>(whole_y);
  const Border border = options.border;
  const int x0 = texel_within(left_x, normals.width(), border),
            x1 = texel_within(left_x + 1, normals.width(), border);
  const int y0 = texel_within(top_y, normals.height(), border),
            y1 = texel_within(top_y + 1, normals.height(), border);
  const auto at = [&](int tap_x, int tap_y) { return clearance(normals, tap_x, tap_y, light, options); };
  return (1 - below) * ((1 - right) * at(x0, y0) + right * at(x1, y0)) +
         below * ((1 - right) * at(x0, y1) + right * at(x1, y1));
}

/// In [0, 1): the same for the same texel and seed, on every machine (PCG's output function as a hash).
float random_part(int x, int y, std::uint32_t seed) {
  const auto hash = [](std::uint32_t value) {
    const std::uint32_t state = value * 747796405U + 2891336453U;
    const std::uint32_t word = ((state >> ((state >> 28U) + 4U)) ^ state) * 277803737U;
    return (word >> 22U) ^ word;
  };
  const std::uint32_t bits =
      hash(static_cast<std::uint32_t>(x) + hash(static_cast<std::uint32_t>(y) + hash(seed)));
  return static_cast<float>(bits >> 8U) * 0x1p-24F;
}

/// The whole walk in texels, which are square; rows run down.
Vec2 whole_walk(const FloatImage& normals, const Vec3& light, float length) {
  const float texels = length * static_cast<float>(std::max(normals.width(), normals.height()));
  return {light.x * texels, -light.y * texels};
}

template <typename PerTexel>
FloatImage each_texel(const FloatImage& normals, PerTexel per_texel) {
  FloatImage result(normals.width(), normals.height(), 1);
  tbb::parallel_for(0, normals.height(), [&](int y) {
    for (int x = 0; x < normals.width(); ++x) result.texel(x, y)[0] = per_texel(x, y);
  });
  return result;
}

}  // namespace

float light_left(const FloatImage& normals, int x, int y, const Vec3& light,
                 const NormalShadowOptions& options) {
  const float start = clearance(normals, x, y, light, options);
  if (start <= 0) return 1;
  const Vec2 walk = whole_walk(normals, light, options.length);
  const float earlier = options.jitter ? random_part(x, y, *options.jitter) : 0;
  const float hardness = options.hardness_used();
  const auto steps = static_cast<float>(options.steps);
  float slope = -start, steepest = 0, shadow = 0;
  for (int step = 1; step <= options.steps; ++step) {
    const float walked = (static_cast<float>(step) - earlier) / steps;
    slope -= clearance_at(normals, x, y, walk * walked, light, options);
    if (slope <= steepest) continue;
    if (options.hard) return 0;
    shadow += hardness * (1 - walked);
    steepest = slope;
  }
  return std::clamp(1 - shadow / steps, 0.0F, 1.0F);
}

FloatImage normal_shadows(const FloatImage& normals, const Vec3& light, const NormalShadowOptions& options) {
  return each_texel(normals, [&](int x, int y) { return light_left(normals, x, y, light, options); });
}

FloatImage lit_by(const FloatImage& normals, const Vec3& light, const FloatImage& factor) {
  return each_texel(normals, [&](int x, int y) {
    return std::max(0.0F, light.dot(vec3_at(normals, x, y))) * factor.texel(x, y)[0];
  });
}

}  // namespace rnmbake
