// trace/path.h - the light that a surface sends back, by path tracing from one point of it.
#pragma once

#include "base/math.h"
#include "trace/sampler.h"
#include "trace/scene.h"

#include <cstdint>

namespace rnmbake {

/// Rays to a light end just before it: a glowing triangle is geometry as well.
inline constexpr float short_of_light = 1 - 1e-4F;

struct PathOptions {
  int bounces = -1;  // -1: no limit
  bool light_sampling = true, chance_hits = true;
};

/// How much a way to find light counts where the other could have found it too (balance heuristic, Veach
/// 1997).
[[nodiscard]] inline float balance(float pdf, float other) {
  return pdf / (pdf + other);
}

/// Unbiased estimate of the diffusely reflected radiance at `vertex` towards the side that it was met from:
/// the same in all directions. Emission of the vertex itself is not in it. `bounces` counts `vertex` as the
/// first. Adds the rays that were shot to `rays`.
[[nodiscard]] Vec3 reflected_radiance(const TraceScene& scene, Vertex vertex, const PathOptions& options,
                                      Sampler& sampler, std::int64_t& rays);

}  // namespace rnmbake
