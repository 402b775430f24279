// trace/path.h - the light that a surface sends back, by path tracing from one point of it.
#pragma once

#include "base/math.h"
#include "sampling/mis.h"
#include "sampling/sampler.h"
#include "trace/recipe.h"
#include "trace/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rnmbake {

/// Where a ray to a light ends: just before it, for a glowing triangle is geometry as well.
[[nodiscard]] inline float shadow_tmax(float distance, float ray_offset) {
  return std::max(0.0F, distance * (1 - 1e-4F) - ray_offset);
}

struct PathOptions {
  int bounces = -1;  // -1: no limit
  int before = 1;    // surfaces that the path bounced off before it came to the vertex
  bool light_sampling = true, sample_bsdf = true;

  /// Where the recipe's self-reflection is made: the target, and the basis vector that it has for a normal.
  const OwnSurface* own = nullptr;
  const Recipe* recipe = nullptr;
  Vec3 basis;
};

/// Weight of light that a ray with density `pdf` met by chance and looking at lights would have found with
/// `light_pdf`.
[[nodiscard]] inline float mis_weight(bool light_sampling, bool sample_bsdf, float pdf, float light_pdf) {
  if (!sample_bsdf) return 0;
  return light_sampling ? balance_heuristic(pdf, light_pdf) : 1;
}

/// Whether Cycles samples that light below a face, too: an even world it leaves to chance.
[[nodiscard]] inline bool sampled_below(const Lights& lights, const LightSample& light) {
  return !(light.sample_bsdf && std::isinf(light.distance) && lights.world_is_even());
}

/// Unbiased estimate of the diffusely reflected radiance at `vertex` towards the side that it was met from:
/// the same in all directions. Emission of the vertex itself is not in it. `bounces` counts `vertex` as the
/// first. Adds the rays that were shot to `rays`.
[[nodiscard]] Vec3 reflected_radiance(const TraceScene& scene, Vertex vertex, const PathOptions& options,
                                      Sampler& sampler, std::int64_t& rays);

}  // namespace rnmbake
