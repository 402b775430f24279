// pipeline/probes/bake_probes.h - light probes baked by Cycles.
#pragma once

#include "base/math.h"
#include "blender/blend_path.h"
#include "blender/blender_session.h"
#include "pipeline/dispatch/bake_timings.h"
#include "pipeline/dispatch/dispatcher.h"
#include "probes/probe_lights.h"
#include "scene/survey.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace rnmbake {

/// What to bake, where. World space.
struct ProbeBake {
  std::span<const Vec3d> positions;
  std::span<const Vec3> directions;  // unit
  ProbeLights lights = ProbeLights::all;
  std::vector<std::string> absent;  // keys of the survey's objects that are to be left out
  DispatchRules rules = {};         // what was baked before
};

struct BakedProbes {
  std::vector<Vec3> irradiance;       // [positions][directions], E/pi, RGB; 0 where nothing was baked
  std::vector<Vec3> standard_errors;  // [positions][directions] of these; empty: not known
  std::vector<bool> baked;            // [positions]
  BakeTimings timings;
};

/// Bakes as the session's settings for everything say: samples, bounces, seed, clamp, device, and how the
/// work is spread over launches; `automatic`: all directions of all positions in one bake call, or as few as
/// limits of atlas, memory and time allow. Unbiased at every direction.
///
/// Light of one kind comes from differences: a DIFFUSE bake with no bounces is the direct light alone, what
/// rays that leave the probe meet of sky and glowing surfaces included, and has the very samples of direct
/// light that a bake with bounces has (so in 3.4.1, 4.3.2 and 5.2.2). So `bounced` = all - direct has no
/// noise of direct light, and `no_lamps` adds direct light without lamps to that. (Blender's own filter
/// INDIRECT loses all light of lamps in 3.4.1: a plane of albedo 0.5 under a sun of E = pi gives 0 from
/// below, not 0.5.) A difference below 0 is rounding, or noise where the two were baked over different
/// atlases after a failure, and becomes 0.
///
/// Positions that Blender failed at are logged as errors and not marked as baked. Throws Interrupted, and
/// Error where going on makes no sense.
[[nodiscard]] BakedProbes bake_probes(BlenderSession& session, const SceneSurvey& survey,
                                      const BlendPath& blend, const ProbeBake& wanted);

}  // namespace rnmbake
