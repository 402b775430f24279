// pipeline/probes/settle_probes.h - probes out of walls, and what each sees around it.
#pragma once

#include "probes/probe_volume.h"
#include "trace/scene.h"

#include <cstddef>
#include <span>
#include <vector>

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

/// The same for new probes of a box, 2^level times as close as those of its grid; their distances are added
/// to `depths`. `reach`: beyond it distances are cut off, units.
SettleCounts settle_probes(const TraceScene& scene, const SettleOptions& options, const ProbeGrid& grid,
                           int level, double reach, std::span<LightProbe> probes, ProbeDepths& depths);

/// How far a probe looks that lights cells 2^level times as small as those of the grid; units. Distances
/// beyond decide nothing: places that it lights lie in the eight cells around it.
[[nodiscard]] double reach_of(const ProbeGrid& grid, int level);
/// How far it may move without meeting another one's cell; units.
[[nodiscard]] double most_move(const ProbeGrid& grid, int level);

/// Looks around again from where some probes of a volume stand: distances, and validity unless faces have no
/// back. `reach`: for each of them. Throws Interrupted.
void look_again(const TraceScene& scene, const SettleOptions& options,
                const std::vector<std::size_t>& numbers, double reach, ProbeVolume& volume);

}  // namespace rnmbake
