#include "probes/fill_probes.h"

#include "probes/probe_tree.h"

#include <algorithm>
#include <vector>

namespace rnmbake {
namespace {

template <typename Values>
void add(Values& sums, const Values& more, float factor) {
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += more[i] * factor;
}

/// Numbers of the probes beside one of a grid, along its axes.
std::vector<std::size_t> neighbours(const ProbeGrid& grid, std::size_t index) {
  const auto nx = static_cast<std::size_t>(grid.counts[0]), ny = static_cast<std::size_t>(grid.counts[1]);
  const std::array<int, 3> at{static_cast<int>(index % nx), static_cast<int>(index / nx % ny),
                              static_cast<int>(index / (nx * ny))};
  std::vector<std::size_t> found;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      std::array<int, 3> beside = at;
      beside[axis] += side;
      if (beside[axis] >= 0 && beside[axis] < grid.counts[axis])
        found.push_back(grid.index(beside[0], beside[1], beside[2]));
    }
  }
  return found;
}

/// The same of all probes, each once: next to each other on edges and in faces of undivided cells.
std::vector<std::vector<std::size_t>> neighbours_in_tree(const ProbeGrid& grid, const ProbeTree& tree,
                                                         std::size_t probes) {
  std::vector<std::vector<std::size_t>> found(probes);
  for (const TreeLeaf& leaf : leaves_of(grid, tree)) {
    for (const std::size_t axis_step : {std::size_t{1}, std::size_t{3}, std::size_t{9}}) {
      for (std::size_t low = 0; low < leaf.nodes.size(); ++low) {
        if (low / axis_step % 3 != 0 || leaf.nodes[low] == no_probe) continue;
        std::size_t last = low;
        for (const std::size_t next : {low + axis_step, low + 2 * axis_step}) {
          if (leaf.nodes[next] == no_probe) continue;
          found[leaf.nodes[last]].push_back(leaf.nodes[next]);
          found[leaf.nodes[next]].push_back(leaf.nodes[last]);
          last = next;
        }
      }
    }
  }
  for (std::vector<std::size_t>& beside : found) {
    std::ranges::sort(beside);
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  }
  return found;
}

}  // namespace

std::size_t fill_probes(ProbeVolume& volume) {
  if (!volume.grid) return 0;
  std::vector<std::vector<std::size_t>> in_tree;
  if (volume.tree) in_tree = neighbours_in_tree(*volume.grid, *volume.tree, volume.probes.size());
  std::vector<char> has_light(volume.probes.size());
  std::ranges::transform(volume.probes, has_light.begin(), is_valid);
  std::size_t filled = 0;
  for (bool more = true; more;) {
    more = false;
    std::vector<char> next = has_light;
    for (std::size_t i = 0; i < volume.probes.size(); ++i) {
      if (has_light[i] != 0) continue;
      std::vector<std::size_t> beside = volume.tree ? in_tree[i] : neighbours(*volume.grid, i);
      std::erase_if(beside, [&](std::size_t other) { return has_light[other] == 0; });
      if (beside.empty()) continue;
      LightProbe& probe = volume.probes[i];
      probe.irradiance.fill(Vec3(0));
      probe.standard_error.fill(Vec3(0));
      probe.harmonics.fill(Vec3(0));
      const float share = 1 / static_cast<float>(beside.size());
      for (const std::size_t other : beside) {
        add(probe.irradiance, volume.probes[other].irradiance, share);
        add(probe.standard_error, volume.probes[other].standard_error, share);
        add(probe.harmonics, volume.probes[other].harmonics, share);
      }
      probe.state = LightProbe::State::filled;
      next[i] = 1;
      ++filled;
      more = true;
    }
    has_light = std::move(next);
  }
  return filled;
}

}  // namespace rnmbake
