// trace/transparency.h - a path's way straight on: through see-through surfaces, to one that it stays at.
//
// At each see-through place a path goes on with the probability TransparentHit::onward, and bounces off
// otherwise; weights make up for it. Rays to lights do not choose: all light that gets through counts. The
// two ways to find light are told apart by direction alone, so what each counts does not depend on what is on
// the way.
#pragma once

#include "sampling/sampler.h"
#include "trace/scene.h"

#include <cstdint>
#include <vector>

namespace rnmbake {

/// Where a path came to.
struct PathHit {
  bool met = false;            // a surface; else it left the scene
  Hit hit;                     // of that surface
  Visibility way;              // to it
  float stop_probability = 1;  // probability to stay there, for one that gets there

  /// Of what is found there.
  [[nodiscard]] Vec3 weight() const {
    return way.transmittance / (way.transmit_probability * stop_probability);
  }
};

/// `glow(hit, radiance)` hears of every glowing surface on the way and at its end, with what is left of its
/// light. Surfaces for which `is_there(triangle)` is false neither glow nor dim; opaque ones still end the
/// way.
template <typename Glow, typename IsThere>
PathHit trace_through(const TraceScene& scene, const Ray& ray, Sampler& sampler, const Glow& glow,
                      const IsThere& is_there) {
  PathHit path_hit;
  const auto shine = [&](const Hit& hit) {
    const std::uint32_t material = scene.triangles().material[hit.triangle];
    if (!scene.materials().emits(material) || !is_there(hit.triangle)) return;
    glow(hit, scene.materials().emission(material, picture_uv(scene, hit)) * path_hit.weight());
  };
  std::vector<TransparentHit> transparent_hits;
  path_hit.met = scene.intersect(ray, path_hit.hit, transparent_hits);
  for (const TransparentHit& transparent_hit : transparent_hits) {
    if (!is_there(transparent_hit.hit.triangle)) continue;
    shine(transparent_hit.hit);
    if (transparent_hit.transmit_probability < 1 &&
        !(sampler.next1() < transparent_hit.transmit_probability)) {
      path_hit.met = true;
      path_hit.hit = transparent_hit.hit;
      path_hit.stop_probability = 1 - transparent_hit.transmit_probability;
      return path_hit;
    }
    path_hit.way.transmittance *= transparent_hit.transmittance;
    path_hit.way.transmit_probability *= transparent_hit.transmit_probability;
  }
  if (path_hit.met) shine(path_hit.hit);
  return path_hit;
}

template <typename Glow>
PathHit trace_through(const TraceScene& scene, const Ray& ray, Sampler& sampler, const Glow& glow) {
  return trace_through(scene, ray, sampler, glow, [](std::uint32_t) { return true; });
}

}  // namespace rnmbake
