// trace/lights/light_sample.h - one sample of the lights around a point.
#pragma once

#include "base/math.h"

namespace rnmbake {

/// Light that arrives at a point from one direction where nothing occludes it.
struct LightSample {
  Vec3 direction{0, 0, 1};  // unit, towards the light
  float distance = 0;       // to it; infinity for suns and the world
  /// Incident radiance; of a delta light radiance x solid angle (its irradiance at normal incidence).
  Vec3 radiance{0, 0, 0};
  /// Per solid angle, the choice of the light included; of a delta light the probability of its choice. 0: no
  /// light arrives.
  float pdf = 0;
  /// Whether a ray sampled by the BSDF can hit it too, so that MIS must weigh the two. Lamps block no rays:
  /// false.
  bool bsdf_can_hit = false;
  /// It lights only paths with at most so many bounces.
  int max_bounces = 1024;
};

/// Which light counts where it arrives without having been reflected.
struct DirectLight {
  bool lamps = true;  // point, spot, area, sun
  bool glow = true;   // emissive surfaces and the sky

  [[nodiscard]] bool takes(const LightSample& light) const { return light.bsdf_can_hit ? glow : lamps; }
};

}  // namespace rnmbake
