// pipeline/bake/dispatcher.h - runs the launches of a plan, several at a time, and finds the offender when one
// fails.
#pragma once

#include "bake/request.h"
#include "blender/blend_path.h"
#include "pipeline/lightmaps/bake_collector.h"
#include "blender/blender_session.h"

#include <vector>

namespace rnmbake {

/// What the launches cost, summed over all of them.
struct BakeTimings {
  int launches = 0, failed_launches = 0;
  double wall_seconds = 0;     // of the whole baking step
  double launch_seconds = 0;   // Blender processes, start to end
  double prepare_seconds = 0;  // inside: receivers and materials
  double bake_seconds = 0;     // inside: bake() calls, i.e. Cycles and its scene synchronisation
  double save_seconds = 0;     // inside: pixels to disk
  std::size_t peak_bytes = 0;  // largest Blender process
};

/// Runs all dispatches of the plan. A failed one is split until the offender is alone (and then tried
/// settings.run.retries times more); what remains is delivered, what failed is given up at the desk. One that
/// hung before it began to bake is tried again as a whole, and where launch after launch hangs, all is given
/// up.
/// Throws Interrupted where the user stops, Error where going on makes no sense (a full disk, no such
/// device).
[[nodiscard]] BakeTimings run_dispatches(Workspace& workspace, const BakeContext& context,
                                         const BlendPath& blend, DeliveryDesk& desk);

/// Blenders at a time: --jobs, else one for joined bakes and one for each core otherwise.
[[nodiscard]] int choose_jobs(const BakeSettings& settings, std::size_t dispatches);

}  // namespace rnmbake
