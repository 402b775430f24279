// probes/cell_lookup.h - which probes stand around a place, of a grid or of a tree.
#pragma once

#include "probes/probe_tree.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rnmbake {

struct ProbeShare {
  std::size_t probe = 0;
  float weight = 0;
};

/// At most the 27 nodes of a cell.
struct ProbeShares {
  std::array<ProbeShare, 27> all;
  std::size_t count = 0;

  void add(std::size_t probe, float weight) { all[count++] = {probe, weight}; }
  [[nodiscard]] std::span<ProbeShare> used() { return std::span(all).first(count); }
  [[nodiscard]] std::span<const ProbeShare> used() const { return std::span(all).first(count); }
};

/// Trilinear between the probes of a cell. The volume must outlive it.
///
/// Where cells of a tree meet larger ones, some of their probes hang: they stand in the middle of an edge or
/// a face of the larger cell, which knows nothing of them. Left so, light would jump there by as much as the
/// probe differs from what lies between the larger cell's corners; with the probe's own value made to fit
/// that, what it knows would be lost. Instead the larger cell takes them in: it is looked up as if it were
/// divided, too, and where no probe stands in the middle of an edge, of a face, or of itself, it has the mean
/// of the ends of that edge, the corners of that face, or all. Both sides of each face then interpolate
/// between the same probes, so that light has no jump where neighbours differ by one level, as those that
/// are refined do; where they differ by more (in files of others) it has one.
class CellLookup {
 public:
  explicit CellLookup(const ProbeVolume& volume);

  /// Weights above 0, which sum to 1; places outside as the nearest on the border.
  [[nodiscard]] ProbeShares around(const Vec3d& place) const;

  /// Least step between probes of the smallest cell that a probe belongs to; units of the scene.
  [[nodiscard]] double least_step(std::size_t probe) const {
    return levels_.empty() ? grid_step_ : grid_step_ / (1 << levels_[probe].finest);
  }

 private:
  const ProbeVolume& volume_;
  double grid_step_;
  std::vector<ProbeLevels> levels_;     // [probes] of a tree
  std::vector<std::uint32_t> hanging_;  // [cells] of a tree: place in nodes_, or no_probe
  std::vector<CellNodes> nodes_;
};

}  // namespace rnmbake
