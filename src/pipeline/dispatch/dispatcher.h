// pipeline/dispatch/dispatcher.h - runs the launches of a plan, several at a time, and finds the offender
// when one fails.
#pragma once

#include "bake/request.h"
#include "blender/blend_path.h"
#include "blender/blender_session.h"
#include "pipeline/dispatch/bake_timings.h"
#include "pipeline/dispatch/picture_sink.h"

#include <cstddef>
#include <filesystem>
#include <functional>

namespace rnmbake {

/// Makes the request of a batch for one of `jobs` Blenders at a time, with its arrays in `folder`.
using MakeRequest =
    std::function<BakeRequest(const Batch& batch, int jobs, const std::filesystem::path& folder)>;

/// Receivers, over atlases as large as settings and memory allow. Keeps references to all three.
[[nodiscard]] MakeRequest receiver_requests(const BakeSettings& settings, const SceneSurvey& survey,
                                            const Plan& plan);

/// Runs all batches of the plan. A failed one is split until the offender is alone (and then tried
/// settings.run.retries times more); what remains is delivered, what failed is given up (PictureSink). One
/// that hung before it began to bake is tried again as a whole, and where launch after launch hangs, all is
/// given up. Throws Interrupted where the user stops, Error where going on makes no sense (a full disk, no
/// such device).
[[nodiscard]] BakeTimings run_batches(BlenderSession& session, const Plan& plan, const BlendPath& blend,
                                      const MakeRequest& make_request, PictureSink& sink);

/// Blenders at a time: --jobs, else one for joined bakes and one for each core otherwise.
[[nodiscard]] int choose_jobs(const BakeSettings& settings, std::size_t batches);

}  // namespace rnmbake
