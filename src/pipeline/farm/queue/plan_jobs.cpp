#include "pipeline/farm/queue/plan_jobs.h"

#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/log.h"
#include "base/text.h"
#include "pipeline/farm/queue/patience.h"
#include "process/stop.h"

#include <algorithm>
#include <utility>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double cancel_seconds = 120;  // Slurm's KillWait is 30 s unless set

/// `exec`, so that signals of Slurm reach rnmbake, which ends its Blender.
constexpr const char* job_script = R"(#!/bin/sh
# job.sh PROGRAM PLAN ID [FIRST] - task FIRST + SLURM_ARRAY_TASK_ID of a plan; without FIRST, its merge.
unset MAKEFLAGS
if [ $# -eq 4 ]; then
  exec "$1" task run --plan "$2" --id "$3" --index $((SLURM_ARRAY_TASK_ID + $4))
fi
exec "$1" task merge --plan "$2" --id "$3"
)";

fs::path queue_folder(const fs::path& plan) {
  return plan / "slurm";
}

void write_jobs(const fs::path& plan, const PlanJobs& jobs) {
  json arrays = json::array();
  for (const JobArray& one : jobs.arrays)
    arrays.push_back({{"id", one.id}, {"first", one.first}, {"count", one.count}});
  const json text{
      {"name", jobs.name}, {"arrays", arrays}, {"merge", jobs.merge}, {"cancelled", jobs.cancelled}};
  write_atomically(queue_folder(plan) / "jobs.json", text.dump(1) + "\n");
}

/// A path as Slurm takes it where it replaces %a and the like.
std::string log_pattern(const fs::path& folder, const std::string& name) {
  std::string text;
  for (const char letter : folder.string()) text += letter == '%' ? "%%" : std::string(1, letter);
  return text + "/" + name;
}

/// Words of one sbatch: the user's overrule the first ones, and the last ones overrule the user's.
std::vector<std::string> submission(const FarmPlan& plan, const QueueOptions& options, const std::string& log,
                                    const std::vector<std::string>& last) {
  std::vector<std::string> words{"--requeue", "--open-mode=append",
                                 "--output=" + log_pattern(queue_folder(plan.folder), log)};
  words.insert(words.end(), options.arguments.begin(), options.arguments.end());
  words.insert(words.end(), last.begin(), last.end());
  for (const std::string& word : {(queue_folder(plan.folder) / "job.sh").string(), options.program.string(),
                                  plan.folder.string(), plan.id})
    words.push_back(word);
  return words;
}

JobArray submit_array(const FarmPlan& plan, const Slurm& slurm, const QueueOptions& options,
                      const PlanJobs& jobs, std::size_t first, std::size_t count) {
  std::vector<std::string> words = submission(
      plan, options, "%A_%a.log", {"--job-name=" + jobs.name, fmt::format("--array=0-{}", count - 1)});
  words.push_back(std::to_string(first));
  return {slurm.submit(words), first, count};
}

/// Whatever became of the tasks: what lacks passes is named, the rest delivered.
std::string submit_merge(const FarmPlan& plan, const Slurm& slurm, const QueueOptions& options,
                         const PlanJobs& jobs) {
  std::vector<std::string> last{"--job-name=" + jobs.name};
  std::string after;
  for (const JobArray& one : jobs.arrays) after += ":" + one.id;
  if (!after.empty()) last.push_back("--dependency=afterany" + after);
  return slurm.submit(submission(plan, options, "merge-%j.log", last));
}

std::vector<SlurmJob> alive_jobs(const Slurm& slurm, const std::string& name) {
  auto jobs = slurm.jobs_named(name);
  if (!jobs) fail(ExitCode::environment, "Slurm does not say which jobs it has; is its controller up?");
  std::erase_if(*jobs, [](const SlurmJob& job) { return !job.is_alive(); });
  return std::move(*jobs);
}

}  // namespace

std::optional<std::size_t> PlanJobs::task_of(const SlurmJob& job) const {
  for (const JobArray& one : arrays) {
    if (one.id == job.id && job.index && *job.index < one.count) return one.first + *job.index;
  }
  return std::nullopt;
}

PlanJobs submit_jobs(const FarmPlan& plan, const Slurm& slurm, const QueueOptions& options) {
  PlanJobs jobs;
  jobs.name = "rnmbake-" + plan.id.substr(0, 12);
  const std::size_t limit = slurm.array_limit();
  make_folders(queue_folder(plan.folder));
  write_atomically(queue_folder(plan.folder) / "job.sh", job_script);
  write_jobs(plan.folder, jobs);  // first, so that `cancel` finds what is handed in from now on by its name
  try {
    for (std::size_t first = 0; first < plan.tasks.size(); first += limit) {
      const std::size_t count = std::min(limit, plan.tasks.size() - first);
      jobs.arrays.push_back(submit_array(plan, slurm, options, jobs, first, count));
      write_jobs(plan.folder, jobs);
    }
    jobs.merge = submit_merge(plan, slurm, options, jobs);
    write_jobs(plan.folder, jobs);
  } catch (const Error&) {
    if (!jobs.arrays.empty() && StopRequest::requested())
      log::warn("Slurm has a part of the tasks; end them with rnmbake cancel {}", plan.folder.string());
    throw_if_stopped();
    if (!jobs.arrays.empty()) slurm.cancel(jobs.name);
    throw;
  }
  return jobs;
}

std::optional<PlanJobs> read_jobs(const fs::path& folder) {
  const fs::path file = queue_folder(folder) / "jobs.json";
  if (!fs::exists(file)) return std::nullopt;
  const json text = parse_json(read_text(file), file.string());
  try {
    PlanJobs jobs;
    jobs.name = text.at("name");
    jobs.merge = text.at("merge");
    jobs.cancelled = text.at("cancelled");
    for (const json& one : text.at("arrays"))
      jobs.arrays.push_back({one.at("id"), one.at("first"), one.at("count")});
    return jobs;
  } catch (const json::exception& problem) {
    fail(ExitCode::invalid_input, "{}: {}; submit again", file.string(), brief(problem));
  }
}

void require_no_jobs(const fs::path& folder, const Slurm& slurm) {
  const auto jobs = read_jobs(folder);
  if (!jobs) return;
  if (const auto alive = alive_jobs(slurm, jobs->name); !alive.empty())
    fail(
        ExitCode::lock_held,
        "Slurm has {} of an earlier plan in {}; wait for them (rnmbake wait {}), or end them (rnmbake cancel "
        "{})",
        counted(alive.size(), "job"), folder.string(), folder.string(), folder.string());
}

std::size_t cancel_jobs(const FarmPlan& plan, PlanJobs jobs, const Slurm& slurm) {
  const std::size_t count = alive_jobs(slurm, jobs.name).size();
  if (count == 0) return 0;
  jobs.cancelled = true;
  write_jobs(plan.folder, jobs);
  slurm.cancel(jobs.name);
  const Patience patience(cancel_seconds);
  for (double pause = 0.2; !alive_jobs(slurm, jobs.name).empty(); pause = std::min(2 * pause, 5.0)) {
    if (patience.is_over())
      fail(ExitCode::environment, "jobs of {} do not end, though Slurm was asked to; see squeue --name={}",
           plan.folder.string(), jobs.name);
    Patience::sleep(pause);
  }
  return count;
}

fs::path log_of(const FarmPlan& plan, const SlurmJob& job) {
  return queue_folder(plan.folder) /
         (job.index ? fmt::format("{}_{}.log", job.id, *job.index) : fmt::format("merge-{}.log", job.id));
}

}  // namespace rnmbake
