#include "cli/farm/queue.h"

#include "base/error.h"
#include "base/log.h"
#include "base/text.h"
#include "cli/flags/command_line.h"
#include "pipeline/farm/queue/plan_jobs.h"
#include "pipeline/farm/queue/queue_view.h"
#include "pipeline/farm/queue/wait_merge.h"
#include "process/stop.h"

#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

/// Of a plan folder, or the output folder that it lies in.
PlanJobs jobs_of(const FarmPlan& plan) {
  auto jobs = read_jobs(plan.folder);
  if (!jobs)
    fail(
        ExitCode::usage,
        "{} was not handed to a queue; 'rnmbake submit --executor slurm' does, and 'rnmbake status' says how "
        "far its tasks are",
        plan.folder.string());
  return std::move(*jobs);
}

int wait(const fs::path& folder) {
  const FarmPlan plan = read_farm_plan(folder);
  StopRequest::install();
  return wait_for_merge(plan, jobs_of(plan), Slurm());
}

int cancel(const fs::path& folder) {
  const FarmPlan plan = read_farm_plan(folder);
  StopRequest::install();
  const std::size_t count = cancel_jobs(plan, jobs_of(plan), Slurm());
  log::info("{}", count == 0 ? "nothing of it runs or waits" : counted(count, "job") + " ended");
  return static_cast<int>(ExitCode::ok);
}

std::function<int()> add_plan_command(CLI::App& app, const char* name, const char* purpose,
                                      int (*run)(const fs::path&)) {
  CLI::App* command = app.add_subcommand(name, purpose);
  auto folder = std::make_shared<fs::path>();
  command->add_option("PLAN", *folder, "folder of a plan, or the output folder that it lies in")->required();
  return [folder, run] { return run(*folder); };
}

}  // namespace

void QueueFlags::add_to(CLI::App& command) {
  command.add_option("--executor", executor, "hand the tasks to this queue, and the merge behind them")
      ->type_name("none|slurm")
      ->check(CLI::IsMember({"none", "slurm"}).description(""))
      ->capture_default_str();
  command
      .add_option("--slurm-arg", slurm_arguments,
                  "for sbatch, as in --slurm-arg=--cpus-per-task=8; may be given again")
      ->type_name("ARG")
      ->allow_extra_args(false);
}

void QueueFlags::require(const fs::path& plan_folder) const {
  if (executor == "none" && !slurm_arguments.empty())
    fail(ExitCode::usage, "--slurm-arg says something to Slurm, which is not asked; add --executor slurm");
  const Slurm slurm;
  if (executor == "slurm") (void)slurm.array_limit();
  require_no_jobs(plan_folder, slurm);
}

bool QueueFlags::submit(const FarmPlan& plan) const {
  if (executor == "none") return false;
  const PlanJobs jobs = submit_jobs(plan, Slurm(), {slurm_arguments, fs::read_symlink("/proc/self/exe")});
  log::info("{} in {} of Slurm, and the merge as job {}", counted(plan.tasks.size(), "task"),
            counted(jobs.arrays.size(), "array"), jobs.merge);
  const std::string folder = shell_word(plan.folder.string());
  std::cout << "# until the lightmaps are there:\nrnmbake wait " << folder << "\n"
            << "# how far it is:\nrnmbake status " << folder << "\n"
            << "# to end it:\nrnmbake cancel " << folder << "\n";
  return true;
}

void show_queue(const FarmPlan& plan, const std::map<std::size_t, TaskResult>& results) {
  const auto jobs = read_jobs(plan.folder);
  if (!jobs) return;
  const auto seen = Slurm().jobs_named(jobs->name);
  if (!seen) {
    std::cout << "Slurm does not answer\n";
    return;
  }
  std::cout << describe(view_of(*seen)) << (jobs->cancelled ? "; cancelled" : "") << "\n";
  for (const std::string& line : ended_without_result(plan, *jobs, *seen, results)) std::cout << line << "\n";
}

std::function<int()> add_wait_command(CLI::App& app) {
  return add_plan_command(
      app, "wait",
      "Wait until the tasks of a plan are merged\n\n"
      "Shows how far the tasks are that `submit --executor slurm` handed in, names objects "
      "that\n"
      "fail, and ends with the exit code of the merge. Where the queue has the jobs no more, "
      "it\n"
      "says so (exit code 2).",
      wait);
}

std::function<int()> add_cancel_command(CLI::App& app) {
  return add_plan_command(app, "cancel",
                          "End the jobs of a plan in its queue\n\n"
                          "Jobs that `submit --executor slurm` handed in end with their Blenders before this "
                          "does.\n"
                          "What is in the cache stays.",
                          cancel);
}

}  // namespace rnmbake
