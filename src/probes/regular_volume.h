// probes/regular_volume.h - trees of light probes as regular grids, for who reads nothing else.
#pragma once

#include "probes/probe_volume.h"

#include <cstddef>
#include <vector>

namespace rnmbake {

struct RegularVolume {
  ProbeVolume volume;                     // without a tree
  std::vector<std::size_t> interpolated;  // numbers of its probes that the tree lacks
};

/// The probes of a volume's tree on a regular grid, 2^level times as fine as its own; level 0 to
/// most_tree_levels. Where the tree has no probe there is what it looks up, by validity: light, standard
/// errors, validity, distances. Throws Error(unsupported) where there is no tree, and Error(invalid_input)
/// where there would be more than most_probes.
[[nodiscard]] RegularVolume regular_volume(const ProbeVolume& volume, int level);

}  // namespace rnmbake
