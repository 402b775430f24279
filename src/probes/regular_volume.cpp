#include "probes/regular_volume.h"

#include "base/error.h"
#include "probes/place_probes.h"
#include "probes/volume_sampler.h"

#include <unordered_map>
#include <utility>

namespace rnmbake {
namespace {

ProbeGrid finer(const ProbeGrid& grid, int level) {
  ProbeGrid made = grid;
  double probes = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    probes *= double(grid.counts[axis] - 1) * (1 << level) + 1;
    if (probes > most_probes) break;
    made.counts[axis] = (grid.counts[axis] - 1) * (1 << level) + 1;
    made.steps[axis] /= 1 << level;
  }
  if (probes > most_probes) {
    fail(ExitCode::invalid_input, "as a regular grid they are more than {} probes: lower --levels",
         most_probes);
  }
  return made;
}

/// Numbers of a tree's probes by their places.
std::unordered_map<std::uint64_t, std::uint32_t> probes_by_place(const ProbeVolume& volume) {
  std::unordered_map<std::uint64_t, std::uint32_t> found;
  const std::vector<CellPlace> places = cell_places(*volume.grid, *volume.tree);
  for (std::size_t cell = 0; cell < places.size(); ++cell) {
    for (std::size_t k = 0; k < 8; ++k) {
      const LatticePlace at = places[cell].node(corner_node(k));
      found.emplace(lattice_number(*volume.grid, at), volume.tree->cells[cell].corners[k]);
    }
  }
  return found;
}

template <typename Values>
void add_share(Values& sums, const Values& more, float share) {
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += more[i] * share;
}

/// Shares of the distances of some probes, as those of the next one.
void add_depths(const ProbeDepths& from, const ProbeShares& shares, ProbeDepths& to) {
  const auto texels = static_cast<std::size_t>(from.side) * static_cast<std::size_t>(from.side);
  for (std::size_t t = 0; t < texels; ++t) {
    float mean = 0, square = 0;
    for (const ProbeShare& share : shares.used()) {
      mean += share.weight * from.mean[share.probe * texels + t];
      square += share.weight * from.square[share.probe * texels + t];
    }
    to.mean.push_back(mean);
    to.square.push_back(square);
  }
}

LightProbe blended_probe(const ProbeVolume& volume, const ProbeShares& shares) {
  LightProbe made;
  made.validity = 0;
  made.state = LightProbe::State::filled;
  for (const ProbeShare& share : shares.used()) {
    const LightProbe& probe = volume.probes[share.probe];
    add_share(made.irradiance, probe.irradiance, share.weight);
    add_share(made.standard_error, probe.standard_error, share.weight);
    add_share(made.harmonics, probe.harmonics, share.weight);
    made.validity += share.weight * probe.validity;
  }
  return made;
}

}  // namespace

RegularVolume regular_volume(const ProbeVolume& volume, int level) {
  if (!volume.tree || !volume.grid) fail(ExitCode::unsupported, "'{}' has no tree", volume.name);
  RegularVolume made{empty_volume(volume.name, finer(*volume.grid, level)), {}};
  const ProbeGrid& grid = *made.volume.grid;
  made.volume.depths.side = volume.depths.side;
  const auto stored = probes_by_place(volume);
  const VolumeSampler between(volume, ProbeEncoding::sh3, LeakTest::validity);
  const int step = lattice_steps >> level;
  std::size_t number = 0;
  for (int z = 0; z < grid.counts[2]; ++z) {
    for (int y = 0; y < grid.counts[1]; ++y) {
      for (int x = 0; x < grid.counts[0]; ++x, ++number) {
        const auto there = stored.find(lattice_number(*volume.grid, {x * step, y * step, z * step}));
        ProbeShares shares;
        if (there != stored.end()) {
          shares.add(there->second, 1);
          made.volume.probes[number] = volume.probes[there->second];
        } else {
          const Vec3d place = grid.place(x, y, z);
          shares = between.shares(place, Vec3(0, 0, 1));  // validity knows no normal
          made.volume.probes[number] = blended_probe(volume, shares);
          made.volume.probes[number].position = place;
          made.interpolated.push_back(number);
        }
        add_depths(volume.depths, shares, made.volume.depths);
      }
    }
  }
  return made;
}

}  // namespace rnmbake
