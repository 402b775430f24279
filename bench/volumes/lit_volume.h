// bench/volumes/lit_volume.h - boxes of probes as `rnmbake probes` makes them, and light at any points.
#pragma once

#include "probes/place_probes.h"
#include "probes/probe_volume.h"
#include "trace/gather_options.h"
#include "trace/gather_point.h"
#include "trace/probes/gather_probes.h"
#include "trace/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace rnmbake {

/// Placed in equal cells of the box, moved out of geometry, lit by the tracer, filled; with distances.
[[nodiscard]] ProbeVolume lit_volume(const TraceScene& scene, const ProbeBounds& bounds, double spacing,
                                     const DirectLight& direct, int samples);

[[nodiscard]] std::vector<GatheredProbe> probes_at(const TraceScene& scene, std::span<const Vec3d> places,
                                                   const DirectLight& direct, int samples,
                                                   std::uint64_t seed);
/// In a sound place.
[[nodiscard]] LightProbe as_probe(const GatheredProbe& gathered);

/// E/pi at the shading normal of each point. Another seed gives independent noise.
[[nodiscard]] std::vector<Vec3> light_at(const TraceScene& scene, const PointSource& points,
                                         const DirectLight& direct, int samples, std::uint64_t seed);

}  // namespace rnmbake
