// pipeline/probes/settle_probes.h - probes out of walls, and what each sees around it.
#pragma once

#include "probes/probe_volume.h"
#include "trace/scene.h"

#include <cstddef>

namespace rnmbake {

struct SettleOptions {
  bool two_sided = false;  // faces have no back: no probe stands inside of something
  bool depth = true;       // keep the distances around the probes of a box
  int threads = 0;         // 0: all cores
};

struct SettleCounts {
  std::size_t moved = 0, buried = 0;  // buried: no place beside them is in the open
};

/// Looks around from each probe. One that meets back faces moves through the nearest, up to half the way to
/// its neighbours, if it is in the open there; fills in validity, state and depths. Throws Interrupted.
SettleCounts settle_probes(const TraceScene& scene, const SettleOptions& options, ProbeVolume& volume);

}  // namespace rnmbake
