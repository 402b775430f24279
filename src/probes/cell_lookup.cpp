#include "probes/cell_lookup.h"

#include <algorithm>

namespace rnmbake {
namespace {

using Share3 = std::array<float, 3>;

/// Of one of eight corners, x fastest.
float trilinear(std::size_t corner, const Share3& at) {
  float weight = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) weight *= (corner >> axis & 1) != 0 ? at[axis] : 1 - at[axis];
  return weight;
}

/// The half that a share lies in; becomes the share of that half.
std::size_t enter_half(float& at) {
  const bool is_high = at >= 0.5F;
  at = 2 * at - (is_high ? 1.0F : 0.0F);
  return is_high ? 1 : 0;
}

/// Gives the weight of a node without a probe to the corners that it lies between, in equal parts.
void spread(std::size_t node, float weight, std::array<float, 27>& weights) {
  const std::array<int, 3> steps = node_steps(node);
  std::size_t middle = 0, high = 0;  // axes, a bit for each
  float share = weight;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (steps[axis] == 1) {
      middle |= std::size_t{1} << axis;
      share /= 2;
    }
    if (steps[axis] == 2) high |= std::size_t{1} << axis;
  }
  for (std::size_t corner = 0; corner < 8; ++corner)
    if ((corner & ~middle) == high) weights[corner_node(corner)] += share;
}

ProbeShares within(const CellNodes& nodes, Share3 at) {
  std::array<std::size_t, 3> half{};
  for (std::size_t axis = 0; axis < 3; ++axis) half[axis] = enter_half(at[axis]);
  std::array<float, 27> weights{};
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const float weight = trilinear(corner, at);
    if (!(weight > 0)) continue;
    std::size_t node = 0;
    for (std::size_t axis = 3; axis-- > 0;) node = 3 * node + half[axis] + (corner >> axis & 1);
    if (nodes[node] == no_probe) {
      spread(node, weight, weights);
    } else {
      weights[node] += weight;
    }
  }
  ProbeShares shares;
  for (std::size_t node = 0; node < weights.size(); ++node)
    if (weights[node] > 0) shares.add(nodes[node], weights[node]);
  return shares;
}

}  // namespace

CellLookup::CellLookup(const ProbeVolume& volume) : volume_(volume) {
  const auto& steps = volume.grid->steps;
  grid_step_ = std::min({steps[0].length(), steps[1].length(), steps[2].length()});
  if (!volume.tree) return;
  const std::vector<TreeLeaf> leaves = leaves_of(*volume.grid, *volume.tree);
  levels_ = levels_of_probes(leaves, volume.probes.size());
  hanging_.assign(volume.tree->cells.size(), no_probe);
  for (const TreeLeaf& leaf : leaves) {
    if (!leaf.has_hanging) continue;
    hanging_[leaf.cell] = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(leaf.nodes);
  }
}

ProbeShares CellLookup::around(const Vec3d& place) const {
  const ProbeGrid& grid = *volume_.grid;
  const Vec3d from_first = grid.coordinates(place);
  std::array<int, 3> low{}, high{};
  Share3 at{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double last = grid.counts[axis] - 1, x = std::clamp(from_first[int(axis)], 0.0, last);
    low[axis] = std::clamp(static_cast<int>(x), 0, std::max(0, grid.counts[axis] - 2));
    high[axis] = std::min(low[axis] + 1, grid.counts[axis] - 1);
    at[axis] = static_cast<float>(x - low[axis]);
  }
  ProbeShares shares;
  if (!volume_.tree) {
    for (std::size_t k = 0; k < 8; ++k) {
      const auto side = [&](std::size_t axis) { return (k >> axis & 1) != 0 ? high[axis] : low[axis]; };
      const float weight = trilinear(k, at);
      if (weight > 0) shares.add(grid.index(side(0), side(1), side(2)), weight);
    }
    return shares;
  }
  const std::vector<ProbeCell>& cells = volume_.tree->cells;
  std::size_t cell = 0;
  for (std::size_t axis = 3; axis-- > 0;)
    cell = cell * static_cast<std::size_t>(grid.counts[axis] - 1) + static_cast<std::size_t>(low[axis]);
  while (cells[cell].children != 0) {
    std::size_t child = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) child |= enter_half(at[axis]) << axis;
    cell = cells[cell].children + child;
  }
  if (hanging_[cell] != no_probe) return within(nodes_[hanging_[cell]], at);
  for (std::size_t k = 0; k < 8; ++k) {
    const float weight = trilinear(k, at);
    if (weight > 0) shares.add(cells[cell].corners[k], weight);
  }
  return shares;
}

}  // namespace rnmbake
