#include "pipeline/dispatch/batch_recipe.h"

#include "pipeline/dispatch/memory.h"

#include <algorithm>
#include <thread>

namespace rnmbake {

namespace fs = std::filesystem;

int choose_jobs(const BakeSettings& settings, std::size_t batches) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int wanted = settings.run.jobs > 0 ? settings.run.jobs : cores;
  return std::clamp(static_cast<int>(batches), 1, wanted);
}

std::function<std::vector<Batch>(const Batch&)> cut_by(const BatchRecipe& recipe, const Plan& plan,
                                                       int jobs) {
  return [&recipe, &plan, jobs](const Batch& batch) {
    return recipe.most_pixels ? cut(batch, plan, recipe.most_pixels(batch, jobs)) : std::vector{batch};
  };
}

BatchRecipe receiver_requests(const BakeSettings& settings, const SceneSurvey& survey, const Plan& plan) {
  return receiver_requests(settings, scene_triangles(survey), plan);
}

BatchRecipe receiver_requests(const BakeSettings& settings, std::int64_t scene_triangles, const Plan& plan) {
  BatchRecipe recipe;
  recipe.most_pixels = [&, scene_triangles](const Batch& batch, int jobs) {
    return atlas_pixels_for(settings, scene_triangles, plan, batch, jobs);
  };
  recipe.request = [&, scene_triangles](const Batch& batch, int jobs, const fs::path& folder) {
    return receiver_request(plan, batch, atlas_pixels_for(settings, scene_triangles, plan, batch, jobs),
                            folder);
  };
  recipe.scene_triangles = scene_triangles;
  return recipe;
}

}  // namespace rnmbake
