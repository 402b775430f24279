#include "probes/fill_probes.h"

#include <algorithm>
#include <vector>

namespace rnmbake {
namespace {

template <typename Values>
void add(Values& sums, const Values& more, float factor) {
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += more[i] * factor;
}

/// Numbers of the probes beside one of a grid.
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

}  // namespace

std::size_t fill_probes(ProbeVolume& volume) {
  if (!volume.grid) return 0;
  std::vector<char> has_light(volume.probes.size());
  std::ranges::transform(volume.probes, has_light.begin(), is_valid);
  std::size_t filled = 0;
  for (bool more = true; more;) {
    more = false;
    std::vector<char> next = has_light;
    for (std::size_t i = 0; i < volume.probes.size(); ++i) {
      if (has_light[i] != 0) continue;
      std::vector<std::size_t> beside = neighbours(*volume.grid, i);
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
