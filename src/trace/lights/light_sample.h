// trace/lights/light_sample.h - light that would arrive at a point.
#pragma once

#include "base/math.h"

namespace rnmbake {

/// Light that would arrive at a point if nothing stood in its way.
struct LightSample {
  Vec3 direction{0, 0, 1};  // unit, towards the light
  float distance = 0;       // to it; infinity for suns and the world
  /// Arriving; for a delta light radiance x solid angle (its irradiance at normal incidence).
  Vec3 radiance{0, 0, 0};
  /// Per solid angle, choice of the light included; for a delta light: of its choice. 0: nothing arrives.
  float pdf = 0;
  /// A ray in this direction could find it too: weigh the two ways against each other.
  bool sample_bsdf = false;
  /// It lights paths that bounced off no more surfaces.
  int max_bounces = 1024;
};

}  // namespace rnmbake
