// trace/primary_rays.h - what the rays of a camera meet, and a picture's rows shared among threads.
#pragma once

#include "sampling/sampler.h"
#include "trace/scene.h"

#include <functional>

namespace rnmbake {

/// The end of a primary ray.
struct PrimaryHit {
  bool met = false;  // a surface; else the ray left the scene
  Vertex vertex;     // of the surface
  Vec3 weight{1};    // of the radiance that leaves the surface, or the world, towards the camera
  Vec3 emitted{0};   // radiance that reaches the camera from surfaces that glow, the last included
};

/// Follows a primary ray to the surface where its path stops, past what is not visible to cameras. What lets
/// light through stops the path at random (trace/transparency.h).
[[nodiscard]] PrimaryHit follow_primary(const TraceScene& scene, Ray ray, Sampler& sampler);

/// Calls `row(y)` for each of `height` rows, from `threads` threads (0: all cores). `progress` receives the
/// share done, one call at a time; `stop` is polled, and once it is true rows are left out.
void trace_rows(int height, int threads, const std::function<void(int)>& row,
                const std::function<void(double)>& progress, const std::function<bool()>& stop);

}  // namespace rnmbake
