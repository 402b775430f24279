#include "pipeline/probes/settle_probes.h"

#include "blender/blender_session.h"
#include "probes/fill_probes.h"
#include "process/stop.h"
#include "trace/probes/surroundings.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace rnmbake {
namespace {

constexpr int depth_side = 16;

float validity_of(const Surroundings& around) {
  return static_cast<float>(1 - around.back_faces);
}

/// Through the nearest back face and a little on.
Vec3d way_out(const Vec3d& from, const Surroundings& around, double most) {
  constexpr double beyond = 0.1;  // of the way that there is
  return from + Vec3d(around.way_out) * std::min(most, around.way_out_distance + beyond * most);
}

std::vector<Surroundings> look(const TraceScene& scene, const std::vector<Vec3d>& places,
                               const SurroundingsOptions& options) {
  auto found = look_around(scene, scene.relative(places), options, [] { return StopRequest::requested(); });
  if (StopRequest::requested()) throw Interrupted{StopRequest::signal()};
  return found;
}

SurroundingsOptions looking_for(const SettleOptions& options, double reach) {
  SurroundingsOptions looking;
  looking.side = depth_side;
  looking.threads = options.threads;
  looking.reach = reach;
  return looking;
}

void settle_all(const TraceScene& scene, const SettleOptions& options, double most, double reach,
                std::span<LightProbe> probes, SettleCounts& counts, std::vector<Surroundings>& around) {
  const SurroundingsOptions looking = looking_for(options, reach);
  std::vector<Vec3d> places;
  for (const LightProbe& probe : probes) places.push_back(probe.position);
  around = look(scene, places, looking);
  if (!options.two_sided) {
    std::vector<std::size_t> movers;
    std::vector<Vec3d> tried;
    for (std::size_t i = 0; i < places.size(); ++i) {
      probes[i].validity = validity_of(around[i]);
      if (is_valid(probes[i]) || !(around[i].way_out_distance < most)) continue;
      movers.push_back(i);
      tried.push_back(way_out(places[i], around[i], most));
    }
    std::vector<Surroundings> there = look(scene, tried, looking);
    for (std::size_t m = 0; m < movers.size(); ++m) {
      LightProbe& probe = probes[movers[m]];
      if (validity_of(there[m]) < least_validity) continue;
      probe.position = tried[m];
      probe.validity = validity_of(there[m]);
      probe.state = LightProbe::State::moved;
      around[movers[m]] = std::move(there[m]);
      ++counts.moved;
    }
  }
  counts.buried += static_cast<std::size_t>(
      std::ranges::count_if(probes, [](const LightProbe& probe) { return !is_valid(probe); }));
}

}  // namespace

double reach_of(const ProbeGrid& grid, int level) {
  return 1.5 * (grid.steps[0] + grid.steps[1] + grid.steps[2]).length() / (1 << level);
}

double most_move(const ProbeGrid& grid, int level) {
  const auto& steps = grid.steps;
  return 0.45 * std::min({steps[0].length(), steps[1].length(), steps[2].length()}) / (1 << level);
}

SettleCounts settle_probes(const TraceScene& scene, const SettleOptions& options, ProbeVolume& volume) {
  if (volume.grid)
    return settle_probes(scene, options, *volume.grid, 0, reach_of(*volume.grid, 0), volume.probes,
                         volume.depths);
  SettleCounts counts;
  std::vector<Surroundings> around;
  settle_all(scene, options, 0, std::numeric_limits<double>::infinity(), volume.probes, counts, around);
  return counts;
}

SettleCounts settle_probes(const TraceScene& scene, const SettleOptions& options, const ProbeGrid& grid,
                           int level, double reach, std::span<LightProbe> probes, ProbeDepths& depths) {
  SettleCounts counts;
  std::vector<Surroundings> around;
  settle_all(scene, options, most_move(grid, level), reach, probes, counts, around);
  if (!options.depth) return counts;
  depths.side = depth_side;
  for (const Surroundings& one : around) {
    depths.mean.insert(depths.mean.end(), one.mean.begin(), one.mean.end());
    depths.square.insert(depths.square.end(), one.square.begin(), one.square.end());
  }
  return counts;
}

void look_again(const TraceScene& scene, const SettleOptions& options,
                const std::vector<std::size_t>& numbers, double reach, ProbeVolume& volume) {
  const SurroundingsOptions looking = looking_for(options, reach);
  std::vector<Vec3d> places;
  for (const std::size_t number : numbers) places.push_back(volume.probes[number].position);
  const std::vector<Surroundings> around = look(scene, places, looking);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!options.two_sided) volume.probes[numbers[i]].validity = validity_of(around[i]);
    if (volume.depths.side == 0) continue;
    const auto first = static_cast<std::ptrdiff_t>(numbers[i] * around[i].mean.size());
    std::ranges::copy(around[i].mean, volume.depths.mean.begin() + first);
    std::ranges::copy(around[i].square, volume.depths.square.begin() + first);
  }
}

}  // namespace rnmbake
