// pipeline/dispatch/batch_recipe.h - how the request of a batch is made, and how many Blenders run at a time.
#pragma once

#include "bake/plan.h"
#include "bake/request.h"
#include "config/bake_settings.h"
#include "scene/survey.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

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

/// Cuts batches as the recipe and `jobs` Blenders at a time want it. Keeps references.
[[nodiscard]] std::function<std::vector<Batch>(const Batch&)> cut_by(const BatchRecipe& recipe,
                                                                     const Plan& plan, int jobs);

/// Receivers, over atlases as large as settings and memory allow. Keeps references to settings and plan.
[[nodiscard]] BatchRecipe receiver_requests(const BakeSettings& settings, std::int64_t scene_triangles,
                                            const Plan& plan);
[[nodiscard]] BatchRecipe receiver_requests(const BakeSettings& settings, const SceneSurvey& survey,
                                            const Plan& plan);

/// Blenders at a time: --jobs, else one for joined bakes and one for each core otherwise.
[[nodiscard]] int choose_jobs(const BakeSettings& settings, std::size_t batches);

}  // namespace rnmbake
