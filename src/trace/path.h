// trace/path.h - radiance reflected at a surface point, by path tracing.
#pragma once

#include "base/math.h"
#include "sampling/mis.h"
#include "sampling/sampler.h"
#include "trace/lights/light_sample.h"
#include "trace/recipe.h"
#include "trace/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rnmbake {

/// Length of a shadow ray: it ends just before the light, since an emissive triangle is geometry as well.
[[nodiscard]] inline float shadow_tmax(float distance, float ray_offset) {
  return std::max(0.0F, distance * (1 - 1e-4F) - ray_offset);
}

struct PathOptions {
  int bounces = -1;  // -1: no limit
  int before = 1;    // bounces of the path before the vertex
  bool sample_lights = true, sample_bsdf = true;
  DirectLight sampled;  // by sampling lights, at each vertex

  /// For the recipe's self-reflection: the target, and the basis vector that replaces its normal. Null: none.
  const OwnSurface* own = nullptr;
  const Recipe* recipe = nullptr;
  Vec3 basis;
};

/// MIS weight of light that a ray sampled by the BSDF with `pdf` hit, and that sampling lights finds with
/// `light_pdf`.
[[nodiscard]] inline float mis_weight(bool sample_lights, bool sample_bsdf, float pdf, float light_pdf) {
  if (!sample_bsdf) return 0;
  return sample_lights ? balance_heuristic(pdf, light_pdf) : 1;
}

/// Whether Cycles samples that light below a face, too: a constant world it leaves to BSDF sampling.
[[nodiscard]] inline bool sampled_below(const Lights& lights, const LightSample& light) {
  return !(light.bsdf_can_hit && std::isinf(light.distance) && lights.world_is_even());
}

/// Unbiased estimate of the diffusely reflected radiance at `vertex` on the side that was hit, the same in
/// all directions. The vertex' own emission is left out. `bounces` counts `vertex` as the first. Adds the
/// number of rays traced to `rays`.
[[nodiscard]] Vec3 reflected_radiance(const TraceScene& scene, Vertex vertex, const PathOptions& options,
                                      Sampler& sampler, std::int64_t& rays);

}  // namespace rnmbake
