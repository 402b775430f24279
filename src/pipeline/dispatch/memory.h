// pipeline/dispatch/memory.h - limits of memory and of atlas pixels on this machine.
#pragma once

#include "bake/plan.h"
#include "config/bake_settings.h"
#include "scene/survey.h"

#include <cstdint>

namespace rnmbake {

/// Bytes that all Blenders together may use: --memory-limit, else 70 % of what is free now.
[[nodiscard]] std::int64_t memory_budget(const BakeSettings& settings);

[[nodiscard]] std::int64_t scene_triangles(const SceneSurvey& survey);

/// Pixels of one atlas of a batch: --atlas-limit, less where memory for one of `jobs` Blenders is short,
/// and less where one pass would take more than several minutes.
[[nodiscard]] std::int64_t atlas_pixels_for(const BakeSettings& settings, std::int64_t scene_triangles,
                                            const Plan& plan, const Batch& batch, int jobs);

}  // namespace rnmbake
