#include "probes/probe_tree.h"

#include "base/error.h"

#include <algorithm>
#include <unordered_map>

namespace rnmbake {
namespace {

std::array<int, 3> roots_along(const ProbeGrid& grid) {
  return {grid.counts[0] - 1, grid.counts[1] - 1, grid.counts[2] - 1};
}

/// 0 or 1 along an axis, of eight corners or children, x fastest.
int side_of(std::size_t corner, std::size_t axis) {
  return static_cast<int>(corner >> axis & 1);
}

std::size_t node_number(int x, int y, int z) {
  return static_cast<std::size_t>(x) + 3 * static_cast<std::size_t>(y) + 9 * static_cast<std::size_t>(z);
}

/// Corners of the grid's cells must be the probes around them.
bool fits_grid(const ProbeGrid& grid, const ProbeTree& tree) {
  const ProbeTree own = undivided_tree(grid);
  if (tree.cells.size() < own.cells.size()) return false;
  for (std::size_t i = 0; i < own.cells.size(); ++i)
    if (tree.cells[i].corners != own.cells[i].corners) return false;
  return true;
}

/// The eight children of a cell agree on the probes of its nodes, and with the cell on its corners.
void check_children(const ProbeTree& tree, std::size_t cell) {
  CellNodes nodes;
  nodes.fill(no_probe);
  for (std::size_t k = 0; k < 8; ++k) nodes[corner_node(k)] = tree.cells[cell].corners[k];
  for (std::size_t child = 0; child < 8; ++child) {
    for (std::size_t k = 0; k < 8; ++k) {
      const std::uint32_t corner = tree.cells[tree.cells[cell].children + child].corners[k];
      std::uint32_t& node = nodes[node_of_child(child, k)];
      if (node == no_probe) node = corner;
      if (node != corner)
        fail(ExitCode::invalid_input, "the cells within cell {} of its tree disagree on their corners", cell);
    }
  }
}

}  // namespace

std::array<int, 3> node_steps(std::size_t node) {
  const auto n = static_cast<int>(node);
  return {n % 3, n / 3 % 3, n / 9};
}

std::size_t corner_node(std::size_t corner) {
  return node_number(2 * side_of(corner, 0), 2 * side_of(corner, 1), 2 * side_of(corner, 2));
}

std::size_t node_of_child(std::size_t child, std::size_t corner) {
  return node_number(side_of(child, 0) + side_of(corner, 0), side_of(child, 1) + side_of(corner, 1),
                     side_of(child, 2) + side_of(corner, 2));
}

LatticePlace CellPlace::node(std::size_t node) const {
  const std::array<int, 3> steps = node_steps(node);
  const int half = size() / 2;
  return {low[0] + steps[0] * half, low[1] + steps[1] * half, low[2] + steps[2] * half};
}

Vec3d lattice_point(const ProbeGrid& grid, const LatticePlace& place) {
  Vec3d point = grid.first;
  for (std::size_t axis = 0; axis < 3; ++axis)
    point += grid.steps[axis] * (double(place[axis]) / lattice_steps);
  return point;
}

std::uint64_t lattice_number(const ProbeGrid& grid, const LatticePlace& place) {
  // At most 2 most_probes * lattice_steps^3 < 2^42.
  std::uint64_t number = 0;
  for (std::size_t axis = 3; axis-- > 0;) {
    const auto count = static_cast<std::uint64_t>(grid.counts[axis] - 1) * lattice_steps + 1;
    number = number * count + static_cast<std::uint64_t>(place[axis]);
  }
  return number;
}

ProbeTree undivided_tree(const ProbeGrid& grid) {
  ProbeTree tree;
  const std::array<int, 3> roots = roots_along(grid);
  for (int z = 0; z < roots[2]; ++z) {
    for (int y = 0; y < roots[1]; ++y) {
      for (int x = 0; x < roots[0]; ++x) {
        ProbeCell cell;
        for (std::size_t k = 0; k < 8; ++k) {
          cell.corners[k] =
              static_cast<std::uint32_t>(grid.index(x + side_of(k, 0), y + side_of(k, 1), z + side_of(k, 2)));
        }
        tree.cells.push_back(cell);
      }
    }
  }
  return tree;
}

void divide_cell(ProbeTree& tree, std::size_t cell, const CellNodes& nodes) {
  tree.cells[cell].children = static_cast<std::uint32_t>(tree.cells.size());
  for (std::size_t child = 0; child < 8; ++child) {
    ProbeCell made;
    for (std::size_t k = 0; k < 8; ++k) made.corners[k] = nodes[node_of_child(child, k)];
    tree.cells.push_back(made);
  }
}

std::vector<CellPlace> cell_places(const ProbeGrid& grid, const ProbeTree& tree) {
  std::vector<CellPlace> places(tree.cells.size());
  const std::array<int, 3> roots = roots_along(grid);
  std::size_t root = 0;
  for (int z = 0; z < roots[2]; ++z)
    for (int y = 0; y < roots[1]; ++y)
      for (int x = 0; x < roots[0]; ++x)
        places[root++].low = {x * lattice_steps, y * lattice_steps, z * lattice_steps};
  for (std::size_t cell = 0; cell < places.size(); ++cell) {
    const CellPlace parent = places[cell];
    if (tree.cells[cell].children == 0) continue;
    for (std::size_t child = 0; child < 8; ++child) {
      CellPlace& place = places[tree.cells[cell].children + child];
      place.level = parent.level + 1;
      for (std::size_t axis = 0; axis < 3; ++axis)
        place.low[axis] = parent.low[axis] + side_of(child, axis) * (parent.size() / 2);
    }
  }
  return places;
}

std::size_t cell_at(const ProbeGrid& grid, const ProbeTree& tree, const LatticePlace& place, int level) {
  const std::array<int, 3> roots = roots_along(grid);
  std::size_t cell = 0;
  for (std::size_t axis = 3; axis-- > 0;)
    cell =
        cell * static_cast<std::size_t>(roots[axis]) + static_cast<std::size_t>(place[axis] / lattice_steps);
  for (int half = lattice_steps / 2; level > 0 && tree.cells[cell].children != 0; half /= 2, --level) {
    std::size_t child = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      child |= static_cast<std::size_t>((place[axis] & half) != 0) << axis;
    cell = tree.cells[cell].children + child;
  }
  return cell;
}

std::vector<TreeLeaf> leaves_of(const ProbeGrid& grid, const ProbeTree& tree) {
  const std::vector<CellPlace> places = cell_places(grid, tree);
  std::unordered_map<std::uint64_t, std::uint32_t> middles;  // of divided cells, and of their faces and edges
  for (std::size_t cell = 0; cell < places.size(); ++cell) {
    if (tree.cells[cell].children == 0) continue;
    for (std::size_t child = 0; child < 8; ++child) {
      const ProbeCell& within = tree.cells[tree.cells[cell].children + child];
      for (std::size_t k = 0; k < 8; ++k) {
        const LatticePlace at = places[cell].node(node_of_child(child, k));
        middles.emplace(lattice_number(grid, at), within.corners[k]);
      }
    }
  }
  std::vector<TreeLeaf> leaves;
  for (std::size_t cell = 0; cell < places.size(); ++cell) {
    if (tree.cells[cell].children != 0) continue;
    TreeLeaf leaf{cell, places[cell], {}, false};
    leaf.nodes.fill(no_probe);
    for (std::size_t k = 0; k < 8; ++k) leaf.nodes[corner_node(k)] = tree.cells[cell].corners[k];
    for (std::size_t node = 0; node < leaf.nodes.size() && leaf.place.size() > 1; ++node) {
      if (leaf.nodes[node] != no_probe) continue;
      const auto found = middles.find(lattice_number(grid, leaf.place.node(node)));
      if (found == middles.end()) continue;
      leaf.nodes[node] = found->second;
      leaf.has_hanging = true;
    }
    leaves.push_back(leaf);
  }
  return leaves;
}

std::vector<ProbeLevels> levels_of_probes(const std::vector<TreeLeaf>& leaves, std::size_t probes) {
  std::vector<ProbeLevels> levels(probes);
  for (const TreeLeaf& leaf : leaves) {
    for (const std::uint32_t probe : leaf.nodes) {
      if (probe == no_probe) continue;
      levels[probe].coarsest = std::min(levels[probe].coarsest, leaf.place.level);
      levels[probe].finest = std::max(levels[probe].finest, leaf.place.level);
    }
  }
  return levels;
}

void check_tree(const ProbeGrid& grid, const ProbeTree& tree, std::size_t probes) {
  if (std::ranges::any_of(grid.counts, [](int count) { return count < 2; }))
    fail(ExitCode::invalid_input, "a tree over a grid of one layer");
  if (!fits_grid(grid, tree))
    fail(ExitCode::invalid_input, "the first cells of its tree are not those of its grid");
  const std::size_t count = tree.cells.size();
  const std::array<int, 3> roots = roots_along(grid);
  const std::size_t own = static_cast<std::size_t>(roots[0]) * static_cast<std::size_t>(roots[1]) *
                          static_cast<std::size_t>(roots[2]);
  std::vector<int> level(count, -1);  // -1: nobody's child yet
  std::fill_n(level.begin(), own, 0);
  for (std::size_t cell = 0; cell < count; ++cell) {
    for (const std::uint32_t corner : tree.cells[cell].corners) {
      if (corner >= probes)
        fail(ExitCode::invalid_input, "cell {} of its tree has probe {} of {}", cell, corner, probes);
    }
    const std::size_t first = tree.cells[cell].children;
    if (first == 0) continue;
    if (level[cell] < 0 || level[cell] == most_tree_levels || first <= cell || first < own ||
        first + 8 > count)
      fail(ExitCode::invalid_input, "the cells within cell {} of its tree are {}", cell, first);
    for (std::size_t child = first; child < first + 8; ++child) {
      if (level[child] >= 0) fail(ExitCode::invalid_input, "cell {} of its tree lies in two others", child);
      level[child] = level[cell] + 1;
    }
  }
  if (std::ranges::count(level, -1) > 0) fail(ExitCode::invalid_input, "cells of its tree lie in no other");
  for (std::size_t cell = 0; cell < count; ++cell)
    if (tree.cells[cell].children != 0) check_children(tree, cell);
}

int depth_of(const ProbeGrid& grid, const ProbeTree& tree) {
  int deepest = 0;
  for (const CellPlace& place : cell_places(grid, tree)) deepest = std::max(deepest, place.level);
  return deepest;
}

}  // namespace rnmbake
