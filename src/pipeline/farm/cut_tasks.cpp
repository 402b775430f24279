#include "pipeline/farm/cut_tasks.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {

double launch_seconds(std::int64_t scene_triangles) {
  return 3 + 4e-6 * double(scene_triangles);
}

std::vector<FarmTask> cut_tasks(const std::vector<FarmBatch>& batches, double wanted, double start) {
  double all = 0;
  for (const FarmBatch& batch : batches) {
    for (const FarmPass& pass : batch.passes) all += pass.seconds;
  }
  // Equal parts of the whole; a pass belongs to the part that its middle lies in.
  const double parts = std::max(1.0, std::ceil(all / std::max(wanted - start, 1.0)));
  const double part = std::max(all / parts, 1e-9);
  std::vector<FarmTask> tasks;
  double before = 0, at = -1;
  for (std::size_t b = 0; b < batches.size(); ++b) {
    for (std::size_t p = 0; p < batches[b].passes.size(); ++p) {
      const double seconds = batches[b].passes[p].seconds;
      const double own = std::min(std::floor((before + seconds / 2) / part), parts - 1);
      if (own > at) tasks.emplace_back();
      at = own;
      FarmTask& task = tasks.back();
      if (task.shares.empty() || task.shares.back().batch != b) {
        task.shares.push_back({b, p, 0});
        task.seconds += start;
      }
      ++task.shares.back().count;
      task.seconds += seconds;
      before += seconds;
    }
  }
  return tasks;
}

double imbalance(const std::vector<FarmTask>& tasks) {
  double all = 0, longest = 0;
  for (const FarmTask& task : tasks) {
    all += task.seconds;
    longest = std::max(longest, task.seconds);
  }
  return all > 0 ? longest * double(tasks.size()) / all : 1;
}

}  // namespace rnmbake
