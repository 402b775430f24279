// trace/probes/gather_probes.h - the reference at points in free space: E/pi for normals all around, and
// harmonics.
#pragma once

#include "base/math.h"
#include "trace/gather_options.h"
#include "trace/scene.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rnmbake {

struct ProbeGatherOptions {
  std::vector<Vec3> directions;  // unit, world space
  DirectLight direct;
  int samples = 256;  // paths for each hemisphere of a probe
  int bounces = -1;   // of a path, the probe not counted; -1: no limit
  std::uint64_t seed = 0;
  int threads = 0;  // 0: all cores
};

/// Light at one point.
struct GatheredProbe {
  std::vector<Vec3> irradiance, standard_error;  // [directions], E/pi
  std::array<Vec3, 9> harmonics;                 // of radiance, world space (encoding/sh.h)
  double back_faces = 0;                         // share of the primary rays that met one
};

/// Unbiased. A probe is two points to gather at, one for each half of the sphere, so that it shares vertices
/// with its neighbours as texels do (trace/block.h): order positions so that neighbours follow each other.
/// `positions`: relative to TraceScene::origin(). Deterministic for a seed at any number of threads.
/// `progress` receives the share done, one call at a time; `stop` is polled, and once it is true the result
/// is left unfinished.
[[nodiscard]] std::vector<GatheredProbe> gather_probes(const TraceScene& scene,
                                                       std::span<const Vec3> positions,
                                                       const ProbeGatherOptions& options,
                                                       const std::function<void(double)>& progress = {},
                                                       const std::function<bool()>& stop = {});

}  // namespace rnmbake
