// pipeline/dispatch/dispatcher.h - runs the launches of a plan, several at a time, and finds the offender
// when one fails.
#pragma once

#include "bake/request.h"
#include "blender/blend_path.h"
#include "blender/blender_session.h"
#include "pipeline/dispatch/bake_timings.h"
#include "pipeline/dispatch/pass_cache.h"
#include "pipeline/dispatch/picture_sink.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

namespace rnmbake {

/// How batches are asked for.
struct BatchRecipe {
  /// Request of a batch for one of `jobs` Blenders at a time, with its arrays in `folder`.
  std::function<BakeRequest(const Batch& batch, int jobs, const std::filesystem::path& folder)> request;
  /// Pixels that a batch may have; none: batches are not cut.
  std::function<std::int64_t(const Batch& batch, int jobs)> most_pixels;
  bool in_passes = true;  // whether a part of the samples can be baked
  std::int64_t scene_triangles = 0;
};

/// Receivers, over atlases as large as settings and memory allow. Keeps references to all three.
[[nodiscard]] BatchRecipe receiver_requests(const BakeSettings& settings, const SceneSurvey& survey,
                                            const Plan& plan);

/// What a run goes by beside the plan.
struct DispatchRules {
  PassCache cache;                 // what was baked before is not baked again
  std::optional<double> deadline;  // on base/clock: the best that fits
  bool halves = true;              // else the samples are one sequence, and no error is known
};

/// Runs the passes of all batches of the plan, but for what the cache holds. A failed batch is tried again
/// where it got on, else split until the offender is alone (and then tried settings.run.retries times more);
/// what remains is delivered, what failed is given up (PictureSink). One that hung before it began to bake is
/// tried again as a whole, and where launch after launch hangs, all is given up. Throws Interrupted where the
/// user stops, Error where going on makes no sense (a full disk, no such device).
[[nodiscard]] BakeTimings run_batches(BlenderSession& session, const Plan& plan, const BlendPath& blend,
                                      const BatchRecipe& recipe, PictureSink& sink,
                                      const DispatchRules& rules = {});

/// Blenders at a time: --jobs, else one for joined bakes and one for each core otherwise.
[[nodiscard]] int choose_jobs(const BakeSettings& settings, std::size_t batches);

}  // namespace rnmbake
