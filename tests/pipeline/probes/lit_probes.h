// tests/pipeline/probes/lit_probes.h - probes of scenes in memory, lit by the reference.
#pragma once

#include "pipeline/probes/refine_probes.h"
#include "probes/fill_probes.h"
#include "trace/probes/gather_probes.h"

#include <algorithm>
#include <vector>

namespace rnmbake {

inline ProbeGatherOptions gathering(int samples) {
  ProbeGatherOptions options;
  options.directions.assign(probe_directions().begin(), probe_directions().end());
  options.samples = samples;
  return options;
}

inline LightProbes by_reference(const TraceScene& scene, int samples) {
  return [&scene, samples](std::span<LightProbe* const> probes, std::uint64_t round) {
    std::vector<Vec3> positions;
    for (const LightProbe* probe : probes) positions.emplace_back(probe->position - scene.origin());
    ProbeGatherOptions options = gathering(samples);
    options.seed = 100 + round;
    const auto gathered = gather_probes(scene, positions, options);
    for (std::size_t i = 0; i < gathered.size(); ++i) {
      std::ranges::copy(gathered[i].irradiance, probes[i]->irradiance.begin());
      std::ranges::copy(gathered[i].standard_error, probes[i]->standard_error.begin());
      probes[i]->harmonics = gathered[i].harmonics;
    }
  };
}

inline std::vector<LightProbe*> valid_probes(ProbeVolume& volume) {
  std::vector<LightProbe*> valid;
  for (LightProbe& probe : volume.probes)
    if (is_valid(probe)) valid.push_back(&probe);
  return valid;
}

}  // namespace rnmbake
