// tests/pipeline/probes/lit_probes.h - probes of scenes in memory, lit by the reference.
#pragma once

#include "pipeline/probes/reference_light.h"
#include "pipeline/probes/refine_probes.h"
#include "probes/fill_probes.h"

#include <vector>

namespace rnmbake {

inline ProbeGatherOptions gathering(int samples) {
  ProbeGatherOptions options = probe_gathering();
  options.samples = samples;
  return options;
}

inline LightProbes by_reference(const TraceScene& scene, int samples) {
  return [&scene, samples](std::span<LightProbe* const> probes, std::uint64_t round) {
    ProbeGatherOptions options = gathering(samples);
    options.seed = 100 + round;
    light_by_reference(scene, probes, options);
  };
}

inline std::vector<LightProbe*> valid_probes(ProbeVolume& volume) {
  std::vector<LightProbe*> valid;
  for (LightProbe& probe : volume.probes)
    if (is_valid(probe)) valid.push_back(&probe);
  return valid;
}

}  // namespace rnmbake
