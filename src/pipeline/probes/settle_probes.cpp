#include "pipeline/probes/settle_probes.h"

#include "blender/blender_session.h"
#include "probes/fill_probes.h"
#include "process/stop.h"
#include "trace/probes/surroundings.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rnmbake {
namespace {

constexpr int depth_side = 16;

/// Distances beyond decide nothing: places that a probe lights lie in the eight cells around it.
double reach_of(const ProbeGrid& grid) {
  return 1.5 * (grid.steps[0] + grid.steps[1] + grid.steps[2]).length();
}

/// How far a probe may move without meeting another one's cell.
double half_step(const ProbeVolume& volume) {
  if (!volume.grid) return 0;
  const auto& steps = volume.grid->steps;
  return 0.45 * std::min({steps[0].length(), steps[1].length(), steps[2].length()});
}

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
  std::vector<Vec3> relative;
  relative.reserve(places.size());
  for (const Vec3d& place : places) relative.emplace_back(place - scene.origin());
  auto found = look_around(scene, relative, options, [] { return StopRequest::requested(); });
  if (StopRequest::requested()) throw Interrupted{StopRequest::signal()};
  return found;
}

}  // namespace

SettleCounts settle_probes(const TraceScene& scene, const SettleOptions& options, ProbeVolume& volume) {
  SurroundingsOptions looking;
  looking.side = depth_side;
  looking.threads = options.threads;
  if (volume.grid) looking.reach = reach_of(*volume.grid);
  std::vector<Vec3d> places;
  for (const LightProbe& probe : volume.probes) places.push_back(probe.position);
  std::vector<Surroundings> around = look(scene, places, looking);
  SettleCounts counts;
  if (!options.two_sided) {
    const double most = half_step(volume);
    std::vector<std::size_t> movers;
    std::vector<Vec3d> tried;
    for (std::size_t i = 0; i < places.size(); ++i) {
      volume.probes[i].validity = validity_of(around[i]);
      if (is_valid(volume.probes[i]) || !(around[i].way_out_distance < most)) continue;
      movers.push_back(i);
      tried.push_back(way_out(places[i], around[i], most));
    }
    std::vector<Surroundings> there = look(scene, tried, looking);
    for (std::size_t m = 0; m < movers.size(); ++m) {
      LightProbe& probe = volume.probes[movers[m]];
      if (validity_of(there[m]) < least_validity) continue;
      probe.position = tried[m];
      probe.validity = validity_of(there[m]);
      probe.state = LightProbe::State::moved;
      around[movers[m]] = std::move(there[m]);
      ++counts.moved;
    }
  }
  counts.buried = static_cast<std::size_t>(
      std::ranges::count_if(volume.probes, [](const LightProbe& probe) { return !is_valid(probe); }));
  if (!options.depth || !volume.grid) return counts;
  volume.depths.side = depth_side;
  for (const Surroundings& one : around) {
    volume.depths.mean.insert(volume.depths.mean.end(), one.mean.begin(), one.mean.end());
    volume.depths.square.insert(volume.depths.square.end(), one.square.begin(), one.square.end());
  }
  return counts;
}

}  // namespace rnmbake
