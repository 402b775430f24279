// pipeline/dispatch/launch_batch.h - one launch of Blender for the passes of a batch that are missing.
#pragma once

#include "blender/blend_path.h"
#include "blender/blender_session.h"
#include "pipeline/dispatch/batch_work.h"

#include <cstdint>
#include <functional>

namespace rnmbake {

/// Bakes what is missing, as one of `jobs` Blenders at a time. Passes are taken in as they are finished, so
/// that those of a launch that fails later count.
[[nodiscard]] LaunchOutcome launch_batch(BlenderSession& session, const BlendPath& blend, int jobs,
                                         BatchWork& work,
                                         const std::function<void(const ProgressEvent&)>& on_progress);

/// What a launch that ended well and left too little failed at.
[[nodiscard]] LaunchFailure no_picture(const BatchWork& work, const Plan& plan);

/// By the model of bake/sample_passes.h.
[[nodiscard]] PassCost cost_of(const Plan& plan, const BatchLayout& layout, std::int64_t scene_triangles);

}  // namespace rnmbake
