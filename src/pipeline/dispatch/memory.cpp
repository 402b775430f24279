#include "pipeline/dispatch/memory.h"

#include <algorithm>
#include <fstream>
#include <string>

namespace rnmbake {
namespace {

/// Texels x samples of a pass that has few samples: minutes on two cores, which is what a crash costs. The
/// same on every machine, so that pictures are.
constexpr std::int64_t work_per_pass = std::int64_t(1) << 27;
constexpr std::int64_t few_samples = 16;

std::int64_t available_memory() {
  std::ifstream meminfo("/proc/meminfo");
  std::string key, unit;
  std::int64_t kibibytes = 0;
  while (meminfo >> key >> kibibytes && std::getline(meminfo, unit)) {
    if (key == "MemAvailable:") return kibibytes * 1024;
  }
  return std::int64_t(4) << 30;  // unknown: what a small machine has
}

}  // namespace

std::int64_t scene_triangles(const SceneSurvey& survey) {
  std::int64_t count = 0;
  for (const Mesh& mesh : survey.meshes) count += static_cast<std::int64_t>(mesh.triangles());
  return count;
}

std::int64_t memory_budget(const BakeSettings& settings) {
  if (settings.bake.memory_limit > 0) return std::int64_t(settings.bake.memory_limit) << 20;
  return available_memory() * 7 / 10;
}

std::int64_t atlas_pixels_for(const BakeSettings& settings, std::int64_t scene_triangles, const Plan& plan,
                              const Batch& batch, int jobs) {
  std::int64_t receiver_triangles = 0;
  for (const std::size_t task : batch.tasks) {
    for (const std::size_t rect : plan.tasks[task].rects) {
      receiver_triangles += static_cast<std::int64_t>(plan.rects[rect].pass.triangles());
    }
  }
  const std::int64_t samples = plan.tasks[batch.tasks.front()].cycles.samples;
  const std::int64_t patience =
      std::max<std::int64_t>(work_per_pass / std::clamp<std::int64_t>(samples, 1, few_samples), 1 << 18);
  const std::int64_t limit = std::min<std::int64_t>(settings.bake.atlas_limit, patience);
  return atlas_pixels(limit, memory_budget(settings) / jobs, scene_triangles, receiver_triangles);
}

}  // namespace rnmbake
