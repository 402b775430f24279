// pipeline/probes/cell_error.h - how far light at a place is from what probes around it say.
#pragma once

#include "probes/probe_volume.h"
#include "probes/volume_sampler.h"

#include <cstddef>

namespace rnmbake {

/// Mean squares over the 14 directions and the colours, of E/pi: of a difference, and of its noise.
struct Difference {
  double square = 0, noise = 0;
};

/// Light traced at a place of the volume, against what the sampler's probes have there. The noise is that of
/// both sides: their squared standard errors, the probes' times the squares of their shares.
[[nodiscard]] Difference difference_at(const ProbeVolume& volume, const VolumeSampler& sampler,
                                       const LightProbe& truth);

/// Share of a cell's node (probes/probe_tree.h) in a mean over the cell by Simpson's rule, times 216.
[[nodiscard]] double simpson_weight(std::size_t node);

}  // namespace rnmbake
