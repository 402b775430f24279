// pipeline/farm/queue/queue_view.h - what Slurm knows of a plan's jobs at a moment, in words.
#pragma once

#include "pipeline/farm/queue/plan_jobs.h"
#include "pipeline/farm/task_result.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

struct QueueView {
  std::size_t running = 0, waiting = 0, ended = 0;
  std::vector<std::string> nodes;  // on which some run, in order of their names
  std::string held;                // the first job that waits for a person, with the reason; "": none

  [[nodiscard]] bool is_anything_alive() const { return running + waiting > 0; }
};

[[nodiscard]] QueueView view_of(const std::vector<SlurmJob>& jobs);

/// "Slurm: 2 running on n1, n2; 3 waiting; 1 ended".
[[nodiscard]] std::string describe(const QueueView& view);

/// Tasks that ended in the queue and left no result: "task 3: TIMEOUT on n2, PLAN/slurm/7_3.log"; those that
/// had not begun by their array.
[[nodiscard]] std::vector<std::string> ended_without_result(const FarmPlan& plan, const PlanJobs& jobs,
                                                            const std::vector<SlurmJob>& seen,
                                                            const std::map<std::size_t, TaskResult>& results);

}  // namespace rnmbake
