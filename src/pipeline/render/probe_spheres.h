// pipeline/render/probe_spheres.h - a small sphere at each light probe, to look at.
#pragma once

#include "probes/probe_volume.h"
#include "scene/diffuse_scene.h"

#include <vector>

namespace rnmbake {

inline constexpr std::size_t most_spheres = 20'000;

/// Adds an object for each probe of each volume, in order, behind the scene's own: white where it stands in
/// the open, green where it was moved there, red where its light comes from its neighbours. Throws
/// Error(unsupported) where there are more than most_spheres.
void add_probe_spheres(const std::vector<ProbeVolume>& volumes, DiffuseScene& scene);

}  // namespace rnmbake
