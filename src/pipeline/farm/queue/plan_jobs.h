// pipeline/farm/queue/plan_jobs.h - a plan handed to Slurm: arrays of its tasks, and the merge behind them.
//
// PLAN/slurm/: jobs.json (the ids), job.sh (what each job runs), a log for each job.
#pragma once

#include "jobs/queue/slurm.h"
#include "pipeline/farm/farm_plan.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

/// Tasks [first, first + count) of the plan as one array.
struct JobArray {
  std::string id;
  std::size_t first = 0, count = 0;
};

struct PlanJobs {
  std::string name;  // that all of them have, and no other job: a controller that was killed gives ids again
  std::vector<JobArray> arrays;
  std::string merge;       // id; "": not handed in
  bool cancelled = false;  // by rnmbake cancel

  /// Of the plan; nothing for jobs that run none.
  [[nodiscard]] std::optional<std::size_t> task_of(const SlurmJob& job) const;
};

struct QueueOptions {
  std::vector<std::string> arguments;  // for each sbatch
  std::filesystem::path program;       // rnmbake, as the nodes see it
};

/// Hands in all tasks and the merge, and writes jobs.json at each step; where Slurm refuses one, the others
/// are taken back. Throws Error(environment), Error(io), Interrupted.
PlanJobs submit_jobs(const FarmPlan& plan, const Slurm& slurm, const QueueOptions& options);

/// Of a plan's folder; nothing where the plan was not handed to a queue. Throws Error(invalid_input).
[[nodiscard]] std::optional<PlanJobs> read_jobs(const std::filesystem::path& folder);

/// Throws Error(lock_held) where jobs of an earlier plan in that folder are not at their end.
void require_no_jobs(const std::filesystem::path& folder, const Slurm& slurm);

/// Asks for the end of all jobs and waits for it. Returns how many there were. Throws Error(environment)
/// where they do not end, Interrupted.
std::size_t cancel_jobs(const FarmPlan& plan, PlanJobs jobs, const Slurm& slurm);

/// The log of a job.
[[nodiscard]] std::filesystem::path log_of(const FarmPlan& plan, const SlurmJob& job);

}  // namespace rnmbake
