// cli/farm/queue.h - plans in the hands of a queue: flags of `rnmbake submit`, a part of `status`; `wait`,
// `cancel`.
#pragma once

#include "pipeline/farm/farm_plan.h"
#include "pipeline/farm/task_result.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace rnmbake {

struct QueueFlags {
  std::string executor = "none";
  std::vector<std::string> slurm_arguments;

  void add_to(CLI::App& command);

  /// Throws Error(usage) for flags that do not fit, Error(environment) where there is no such queue,
  /// Error(lock_held) where it has jobs of an earlier plan in that folder.
  void require(const std::filesystem::path& plan_folder) const;

  /// Hands the plan in and says what comes next; false where there is no queue to hand it to.
  [[nodiscard]] bool submit(const FarmPlan& plan) const;
};

/// A line of what the queue knows; nothing for a plan that none has.
void show_queue(const FarmPlan& plan, const std::map<std::size_t, TaskResult>& results);

/// Each adds its command; what is returned runs it and gives the exit code.
[[nodiscard]] std::function<int()> add_wait_command(CLI::App& app);
[[nodiscard]] std::function<int()> add_cancel_command(CLI::App& app);

}  // namespace rnmbake
