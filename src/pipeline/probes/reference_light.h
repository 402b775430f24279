// pipeline/probes/reference_light.h - light probes lit by the reference, until a user stops it.
#pragma once

#include "probes/probe_volume.h"
#include "trace/probes/gather_probes.h"
#include "trace/scene.h"

#include <functional>
#include <span>
#include <vector>

namespace rnmbake {

/// For the directions of a light probe; else as the defaults are.
[[nodiscard]] ProbeGatherOptions probe_gathering();

/// Gathers at places in the world. Throws Interrupted.
[[nodiscard]] std::vector<GatheredProbe> gather_at(const TraceScene& scene, std::span<const Vec3d> places,
                                                   const ProbeGatherOptions& options,
                                                   const std::function<void(double)>& progress = {});

/// Gathers at the probes' positions, and gives them their light. `options`: of probe_gathering(). Throws
/// Interrupted.
void light_by_reference(const TraceScene& scene, std::span<LightProbe* const> probes,
                        const ProbeGatherOptions& options, const std::function<void(double)>& progress = {});

}  // namespace rnmbake
