// trace/transparency.h - a path's way straight on: through see-through surfaces, to one that it stays at.
//
// At each see-through place a path goes on with the probability Crossing::onward, and bounces off otherwise;
// weights make up for it. Rays to lights do not choose: all light that gets through counts. The two ways to
// find light are told apart by direction alone, so what each counts does not depend on what is on the way.
#pragma once

#include "sampling/sampler.h"
#include "trace/scene.h"

#include <cstdint>
#include <vector>

namespace rnmbake {

/// Where a path came to.
struct Arrival {
  bool met = false;  // a surface; else it left the scene
  Hit hit;           // of that surface
  Visibility way;    // to it
  float stays = 1;   // probability to stay there, for one that gets there

  /// Of what is found there.
  [[nodiscard]] Vec3 weight() const { return way.transmittance / (way.onward * stays); }
};

/// `glow(hit, radiance)` hears of every glowing surface on the way and at its end, with what is left of its
/// light. Surfaces for which `is_there(triangle)` is false neither glow nor dim; opaque ones still end the
/// way.
template <typename Glow, typename IsThere>
Arrival follow(const TraceScene& scene, const Ray& ray, Sampler& sampler, const Glow& glow,
               const IsThere& is_there) {
  Arrival arrival;
  const auto shine = [&](const Hit& hit) {
    const std::uint32_t look = scene.triangles().look[hit.triangle];
    if (!scene.looks().emits(look) || !is_there(hit.triangle)) return;
    glow(hit, scene.looks().emission(look, picture_uv(scene, hit)) * arrival.weight());
  };
  std::vector<Crossing> crossings;
  arrival.met = scene.intersect(ray, arrival.hit, crossings);
  for (const Crossing& crossing : crossings) {
    if (!is_there(crossing.hit.triangle)) continue;
    shine(crossing.hit);
    if (crossing.onward < 1 && !(sampler.next1() < crossing.onward)) {
      arrival.met = true;
      arrival.hit = crossing.hit;
      arrival.stays = 1 - crossing.onward;
      return arrival;
    }
    arrival.way.transmittance *= crossing.transmittance;
    arrival.way.onward *= crossing.onward;
  }
  if (arrival.met) shine(arrival.hit);
  return arrival;
}

template <typename Glow>
Arrival follow(const TraceScene& scene, const Ray& ray, Sampler& sampler, const Glow& glow) {
  return follow(scene, ray, sampler, glow, [](std::uint32_t) { return true; });
}

}  // namespace rnmbake
