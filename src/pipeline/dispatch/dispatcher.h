// pipeline/dispatch/dispatcher.h - runs the launches of a plan, several at a time, and finds the offender
// when one fails.
#pragma once

#include "blender/blend_path.h"
#include "blender/blender_session.h"
#include "pipeline/dispatch/bake_timings.h"
#include "pipeline/dispatch/batch_recipe.h"
#include "pipeline/dispatch/kept_targets.h"
#include "pipeline/dispatch/pass_cache.h"
#include "pipeline/dispatch/picture_sink.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

/// What a run goes by beside the plan.
struct DispatchRules {
  PassCache cache;                 // what was baked before is not baked again
  std::optional<double> deadline;  // on base/clock: the best that fits
  /// Bakes these passes alone, which stay in the cache, and takes no notice of targets that lie there.
  std::vector<MissingBatch> shares = {};
  /// Where it is there, nothing is launched. A target that the cache does not hold all passes of, of its
  /// batch or of the pieces into which that was split, is given up for the reason that this says.
  std::function<std::string(std::size_t target)> why_missing = {};
  bool preview = false;  // the sink is shown what the first passes bring
  bool halves = true;    // else the samples are one sequence, and no error is known
};

/// Runs the passes of all batches of the plan, but for what the cache holds. A failed batch is tried again
/// where it got on, else split until the offender is alone (and then tried settings.run.retries times more);
/// what remains is delivered, what failed is given up (PictureSink). One that hung before it began to bake is
/// tried again as a whole, and where launch after launch hangs, all is given up. Throws Interrupted where the
/// user stops, Error where going on makes no sense (a full disk, no such device).
[[nodiscard]] BakeTimings run_batches(BlenderSession& session, const Plan& plan, const BlendPath& blend,
                                      const BatchRecipe& recipe, PictureSink& sink,
                                      const DispatchRules& rules = {});

}  // namespace rnmbake
