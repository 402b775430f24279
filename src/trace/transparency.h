// trace/transparency.h - follows a ray straight through see-through surfaces to the one where a path stops.
//
// At each see-through hit a path goes on with TransparentHit::transmit_probability, and bounces there
// otherwise; weights keep it unbiased. Shadow rays do not choose: all light that is transmitted counts. The
// densities of light sampling and BSDF sampling are those of directions alone, so that MIS weights do not
// depend on the see-through surfaces between.
#pragma once

#include "sampling/sampler.h"
#include "trace/scene.h"

#include <cstdint>
#include <vector>

namespace rnmbake {

/// The end of a path segment.
struct PathHit {
  bool met = false;  // a surface; else the ray left the scene
  Hit hit;
  Visibility visibility;       // of the hit from the origin
  float stop_probability = 1;  // of a path that reaches the hit

  /// Of radiance that leaves the hit towards the origin.
  [[nodiscard]] Vec3 weight() const {
    return visibility.transmittance / (visibility.transmit_probability * stop_probability);
  }
};

/// Calls `on_emission(hit, radiance)` for every emissive surface along the ray and at its end, with the
/// radiance that reaches the origin. Surfaces for which `is_visible(triangle)` is false neither emit nor
/// absorb; opaque ones end the segment all the same.
template <typename OnEmission, typename IsVisible>
PathHit trace_through(const TraceScene& scene, const Ray& ray, Sampler& sampler,
                      const OnEmission& on_emission, const IsVisible& is_visible) {
  PathHit path_hit;
  const auto report_emission = [&](const Hit& hit) {
    const std::uint32_t material = scene.triangles().material[hit.triangle];
    if (!scene.materials().emits(material) || !is_visible(hit.triangle)) return;
    on_emission(hit, scene.materials().emission(material, picture_uv(scene, hit)) * path_hit.weight());
  };
  std::vector<TransparentHit> transparent_hits;
  path_hit.met = scene.intersect(ray, path_hit.hit, transparent_hits);
  for (const TransparentHit& transparent_hit : transparent_hits) {
    if (!is_visible(transparent_hit.hit.triangle)) continue;
    report_emission(transparent_hit.hit);
    if (transparent_hit.transmit_probability < 1 &&
        !(sampler.next1() < transparent_hit.transmit_probability)) {
      path_hit.met = true;
      path_hit.hit = transparent_hit.hit;
      path_hit.stop_probability = 1 - transparent_hit.transmit_probability;
      return path_hit;
    }
    path_hit.visibility.transmittance *= transparent_hit.transmittance;
    path_hit.visibility.transmit_probability *= transparent_hit.transmit_probability;
  }
  if (path_hit.met) report_emission(path_hit.hit);
  return path_hit;
}

template <typename OnEmission>
PathHit trace_through(const TraceScene& scene, const Ray& ray, Sampler& sampler,
                      const OnEmission& on_emission) {
  return trace_through(scene, ray, sampler, on_emission, [](std::uint32_t) { return true; });
}

}  // namespace rnmbake
