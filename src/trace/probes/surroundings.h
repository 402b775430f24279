// trace/probes/surroundings.h - how far a point in free space sees, and whether it is inside of something.
#pragma once

#include "base/math.h"
#include "trace/scene.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace rnmbake {

struct SurroundingsOptions {
  int side = 16;                                           // texels of the octahedral map of distances
  int rays_per_texel = 4;                                  // a square of them, at least 1
  double reach = std::numeric_limits<double>::infinity();  // distances beyond are cut off
  int threads = 0;                                         // 0: all cores
};

/// What the rays from a point meet. Surfaces that light goes through are none.
struct Surroundings {
  double back_faces = 0;  // share of the rays that meet the back of a face first
  double nearest = std::numeric_limits<double>::infinity();  // distance of the nearest face of either side
  /// Towards the nearest back face, and its distance; infinite where there is none.
  Vec3 way_out{0, 0, 0};
  double way_out_distance = std::numeric_limits<double>::infinity();
  std::vector<float> mean, square;  // [side][side] of distances and of their squares (sampling/octahedral.h)
};

/// Rays in the same directions from each point: relative to TraceScene::origin(). `stop` as gather_probes().
[[nodiscard]] std::vector<Surroundings> look_around(const TraceScene& scene, std::span<const Vec3> points,
                                                    const SurroundingsOptions& options,
                                                    const std::function<bool()>& stop = {});

}  // namespace rnmbake
