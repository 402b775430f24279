// probes/fill_probes.h - light for probes that stand inside of something.
#pragma once

#include "probes/probe_volume.h"

#include <cstddef>

namespace rnmbake {

/// Probes below it stand inside of something, or behind a wall.
inline constexpr float least_validity = 0.75F;

[[nodiscard]] inline bool is_valid(const LightProbe& probe) {
  return probe.validity >= least_validity;
}

/// Gives each probe of a grid that is not valid the mean light of its neighbours along the axes, or along the
/// edges of its tree's cells, from those that are valid outwards; keeps its validity. Returns the number of
/// probes filled; 0 where none is valid.
std::size_t fill_probes(ProbeVolume& volume);

}  // namespace rnmbake
