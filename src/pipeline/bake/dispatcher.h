// pipeline/bake/dispatcher.h - runs the launches of a plan, several at a time, and finds the offender when
// one fails.
#pragma once

#include "bake/request.h"
#include "blender/blend_path.h"
#include "blender/blender_session.h"
#include "pipeline/lightmaps/bake_collector.h"
#include "pipeline/lightmaps/bake_timings.h"

#include <vector>

namespace rnmbake {

/// Runs all batches of the plan. A failed one is split until the offender is alone (and then tried
/// settings.run.retries times more); what remains is delivered, what failed is given up (BakeCollector). One
/// that hung before it began to bake is tried again as a whole, and where launch after launch hangs, all is
/// given up. Throws Interrupted where the user stops, Error where going on makes no sense (a full disk, no
/// such device).
[[nodiscard]] BakeTimings run_batches(BlenderSession& session, const BakeContext& context,
                                      const BlendPath& blend, BakeCollector& collector);

/// Blenders at a time: --jobs, else one for joined bakes and one for each core otherwise.
[[nodiscard]] int choose_jobs(const BakeSettings& settings, std::size_t batches);

}  // namespace rnmbake
