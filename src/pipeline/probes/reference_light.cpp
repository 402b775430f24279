#include "pipeline/probes/reference_light.h"

#include "blender/blender_session.h"
#include "process/stop.h"

#include <algorithm>

namespace rnmbake {

ProbeGatherOptions probe_gathering() {
  ProbeGatherOptions options;
  options.directions.assign(probe_directions().begin(), probe_directions().end());
  return options;
}

std::vector<GatheredProbe> gather_at(const TraceScene& scene, std::span<const Vec3d> places,
                                     const ProbeGatherOptions& options,
                                     const std::function<void(double)>& progress) {
  auto gathered = gather_probes(scene, scene.relative(places), options, progress,
                                [] { return StopRequest::requested(); });
  if (StopRequest::requested()) throw Interrupted{StopRequest::signal()};
  return gathered;
}

void light_by_reference(const TraceScene& scene, std::span<LightProbe* const> probes,
                        const ProbeGatherOptions& options, const std::function<void(double)>& progress) {
  std::vector<Vec3d> places;
  places.reserve(probes.size());
  for (const LightProbe* probe : probes) places.push_back(probe->position);
  const std::vector<GatheredProbe> gathered = gather_at(scene, places, options, progress);
  for (std::size_t i = 0; i < probes.size(); ++i) {
    std::ranges::copy(gathered[i].irradiance, probes[i]->irradiance.begin());
    std::ranges::copy(gathered[i].standard_error, probes[i]->standard_error.begin());
    probes[i]->harmonics = gathered[i].harmonics;
  }
}

}  // namespace rnmbake
