// probes/probe_tree.h - octrees of light probes: cells, their probes, and how they meet.
#pragma once

#include "probes/probe_volume.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace rnmbake {

/// Divisions of a grid's cell into halves along each axis; more are a slip of the keyboard.
inline constexpr int most_tree_levels = 6;

/// Numbers of cells are exact in the floats of files.
inline constexpr int most_tree_cells = 1 << 24;

inline constexpr std::uint32_t no_probe = std::numeric_limits<std::uint32_t>::max();

/// Probes at the corners of a cell, and in the middles of its edges, of its faces and of itself: 3 along each
/// axis, x fastest; no_probe where none stands.
using CellNodes = std::array<std::uint32_t, 27>;
/// 0, 1 or 2 along each axis.
[[nodiscard]] std::array<int, 3> node_steps(std::size_t node);
/// Number of the node that is a corner, x fastest.
[[nodiscard]] std::size_t corner_node(std::size_t corner);

/// Number of the node that is a corner of one of the cell's eight children, both x fastest.
[[nodiscard]] std::size_t node_of_child(std::size_t child, std::size_t corner);

/// Places of a tree, in steps of its finest lattice from the grid's first probe.
using LatticePlace = std::array<int, 3>;
inline constexpr int lattice_steps = 1 << most_tree_levels;  // from one probe of the grid to the next

struct CellPlace {
  int level = 0;  // 0: between probes of the grid
  LatticePlace low{0, 0, 0};
  [[nodiscard]] int size() const { return lattice_steps >> level; }
  /// Its nodes are places of the lattice below the deepest level alone.
  [[nodiscard]] LatticePlace node(std::size_t node) const;
};

/// World space.
[[nodiscard]] Vec3d lattice_point(const ProbeGrid& grid, const LatticePlace& place);
/// Unlike for each place in the grid.
[[nodiscard]] std::uint64_t lattice_number(const ProbeGrid& grid, const LatticePlace& place);

/// Cells of a grid, not divided; at least two probes along each axis.
[[nodiscard]] ProbeTree undivided_tree(const ProbeGrid& grid);

/// Divides a cell into eight. `nodes`: all 27 probes; the corners must be the cell's own.
void divide_cell(ProbeTree& tree, std::size_t cell, const CellNodes& nodes);

/// [cells].
[[nodiscard]] std::vector<CellPlace> cell_places(const ProbeGrid& grid, const ProbeTree& tree);

/// The cell of `level`, or the undivided one above it, that a place lies in: from its low side on, up to its
/// high side. The place must lie between the grid's outermost probes, short of the last.
[[nodiscard]] std::size_t cell_at(const ProbeGrid& grid, const ProbeTree& tree, const LatticePlace& place,
                                  int level);

/// A cell that is not divided.
struct TreeLeaf {
  std::size_t cell = 0;
  CellPlace place;
  CellNodes nodes{};  // beside its corners those that smaller cells next to it have on its faces and edges
  bool has_hanging = false;  // there are such
};
[[nodiscard]] std::vector<TreeLeaf> leaves_of(const ProbeGrid& grid, const ProbeTree& tree);

/// Levels of the largest and of the smallest undivided cell that a probe is a node of: [probes].
struct ProbeLevels {
  int coarsest = most_tree_levels, finest = 0;
};
[[nodiscard]] std::vector<ProbeLevels> levels_of_probes(const std::vector<TreeLeaf>& leaves,
                                                        std::size_t probes);

/// Throws Error(invalid_input), saying what is wrong, unless the cells are octrees over the grid's own cells
/// whose corners are probes of the volume, each cell's those that its parent and its siblings have there.
void check_tree(const ProbeGrid& grid, const ProbeTree& tree, std::size_t probes);

/// Level of the smallest cell.
[[nodiscard]] int depth_of(const ProbeGrid& grid, const ProbeTree& tree);

}  // namespace rnmbake
