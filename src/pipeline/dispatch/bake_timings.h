// pipeline/dispatch/bake_timings.h - time and memory of a bake's launches.
#pragma once

#include <cstddef>

namespace rnmbake {

/// Sums over all launches.
struct BakeTimings {
  int launches = 0, failed_launches = 0;
  double wall_seconds = 0;     // of the whole baking step
  double launch_seconds = 0;   // Blender processes, start to end
  double prepare_seconds = 0;  // inside: receivers and materials
  double bake_seconds = 0;     // inside: bake() calls, i.e. Cycles and its scene synchronisation
  double save_seconds = 0;     // inside: pixels to disk
  std::size_t peak_bytes = 0;  // largest Blender process
};

}  // namespace rnmbake
