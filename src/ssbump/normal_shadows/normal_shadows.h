// ssbump/normal_shadows/normal_shadows.h - shadows that a bumpy surface casts on itself, out of its normal
// map alone.
#pragma once

#include "base/math.h"
#include "image/float_image.h"
#include "image/sample.h"

#include <cstdint>
#include <optional>

namespace rnmbake {

/// The published parameters. From a texel normals are sampled towards the light, and the rise of their slopes
/// over the light's ray is summed: where the sum is above 0 the surface stands in the light.
struct NormalShadowOptions {
  float length = 0.22F;  // H: length of the walk, as share of the map's longer side times |light.xy|
  int steps = 32;        // N
  std::optional<float> hardness{};  // empty: 50 H
  bool hard = false;                // 0 or 1: stops at the first step that is in the light
  Border border = Border::wrap;
  /// Sums dot(light, n) / n.z instead of dot(light, n): how far the surface really rises over the ray. An
  /// extension of ours.
  bool true_slopes = false;
  std::optional<std::uint32_t> jitter{};  // a seed: each texel starts a random part of a step earlier

  [[nodiscard]] float hardness_used() const { return hardness.value_or(50 * length); }
};

/// Boris Vorontsov, "Normal Mapping Shadows" (2020): the share of the light that is left at texel (x, y), in
/// [0, 1]; 1 where the normal faces away, as there is nothing to shadow. `normals`: unit, tangent space, y
/// up. `light`: unit, towards the light.
[[nodiscard]] float light_left(const FloatImage& normals, int x, int y, const Vec3& light,
                               const NormalShadowOptions& options);

/// The same for each texel; one channel.
[[nodiscard]] FloatImage normal_shadows(const FloatImage& normals, const Vec3& light,
                                        const NormalShadowOptions& options);

/// Lambert's cosine sat(dot(light, n)) of each texel times `factor` (one channel, same size).
[[nodiscard]] FloatImage lit_by(const FloatImage& normals, const Vec3& light, const FloatImage& factor);

}  // namespace rnmbake
