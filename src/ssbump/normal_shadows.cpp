#include "ssbump/normal_shadows.h"

#include <algorithm>
#include <cstddef>

#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

Vec3 normal_at(const FloatImage& normals, int x, int y) {
  const auto texel = normals.texel(x, y);
  return {texel[0], texel[1], texel[2]};
}

/// dot(light, n) between texels, filtered as a graphics card does: normals are not stretched to unit length.
float facing(const FloatImage& normals, const Vec2& uv, const Vec3& light, Border border) {
  float sum = 0;
  for (const Tap& tap : bilinear_taps(normals, uv, border))
    sum += tap.weight * light.dot(normal_at(normals, tap.x, tap.y));
  return sum;
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

/// The whole walk in UV; square texels, so that a longer side has the smaller UV step.
Vec2 whole_walk(const FloatImage& normals, const Vec3& light, float length) {
  const auto longer = static_cast<float>(std::max(normals.width(), normals.height()));
  return {light.x * length * longer / static_cast<float>(normals.width()),
          light.y * length * longer / static_cast<float>(normals.height())};
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
  const float lit = light.dot(normal_at(normals, x, y));
  if (lit <= 0) return 1;
  const Vec2 start = texel_uv(normals, x, y), walk = whole_walk(normals, light, options.length);
  const float earlier = options.jitter ? random_part(x, y, *options.jitter) : 0;
  const float hardness = options.hardness_used();
  const auto steps = static_cast<float>(options.steps);
  float slope = -lit, steepest = 0, shadow = 0;
  for (int step = 1; step <= options.steps; ++step) {
    const float walked = (static_cast<float>(step) - earlier) / steps;
    slope -= facing(normals, start + walk * walked, light, options.border);
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
    return std::max(0.0F, light.dot(normal_at(normals, x, y))) * factor.texel(x, y)[0];
  });
}

}  // namespace rnmbake
