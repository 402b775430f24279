#include "cli/farm/farm.h"

#include "base/error.h"
#include "base/log.h"
#include "base/text.h"
#include "pipeline/farm/run_task.h"
#include "pipeline/farm/task_result.h"
#include "process/stop.h"

#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

struct TaskFlags {
  std::filesystem::path plan;
  std::size_t index = 0;
  NodeSettings node;
};

/// What the queue gave this task; 0: nothing is known.
int threads_of_queue() {
  const char* text = std::getenv("SLURM_CPUS_PER_TASK");
  return text == nullptr ? 0 : std::max(0, std::atoi(text));
}

int run(TaskFlags flags) {
  if (flags.node.threads == 0) flags.node.threads = threads_of_queue();
  const FarmPlan plan = read_farm_plan(flags.plan);
  const TaskResult result = run_task(plan, flags.index, flags.node);
  if (!result.failed.empty()) {
    log::warn("task {}: {} failed; the rest of it is in the cache", flags.index,
              counted(result.failed.size(), "object"));
    return static_cast<int>(ExitCode::tasks_failed);
  }
  log::info("task {} of {}: done in {:.1f} s", flags.index, plan.tasks.size(), result.seconds);
  return static_cast<int>(ExitCode::ok);
}

int show(const FarmPlan& plan) {
  const auto results = read_task_results(plan);
  std::size_t done = 0, failed = 0, begun = 0;
  for (const auto& [task, result] : results) ++(result.failed.empty() ? done : failed);
  for (std::size_t task = 0; task < plan.tasks.size(); ++task)
    begun += !results.contains(task) && has_begun(plan, task) ? 1 : 0;
  std::cout << fmt::format("{}: {} done, {} failed, {} begun, {} not begun\n",
                           counted(plan.tasks.size(), "task"), done, failed, begun,
                           plan.tasks.size() - done - failed - begun);
  for (const auto& [task, result] : results) {
    for (const FailedObject& one : result.failed)
      std::cout << fmt::format("task {} on {}: {}{}\n", task, result.host,
                               one.object.empty() ? "" : printable(one.object) + ": ", printable(one.reason));
  }
  const auto code = merged(plan);
  if (code) std::cout << fmt::format("merged, with exit code {}\n", *code);
  return static_cast<int>(ExitCode::ok);
}

}  // namespace

std::function<int()> add_task_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("task", "Run a task of a plan that rnmbake submit made");
  command->require_subcommand(0, 1);
  CLI::App* run_command = command->add_subcommand("run", "bake the passes of a task that the cache lacks");
  auto flags = std::make_shared<TaskFlags>();
  run_command->add_option("--plan", flags->plan, "folder of the plan")->type_name("PATH")->required();
  run_command->add_option("--index", flags->index, "which task, from 0")->type_name("N")->required();
  run_command->add_option("--blender", flags->node.blender, "Blender of this machine, of the same build")
      ->type_name("PROGRAM");
  run_command->add_option("--threads", flags->node.threads, "threads of Blender")
      ->type_name("N")
      ->check(CLI::Range(0, 1024));
  run_command->add_flag("--keep-temporary", flags->node.keep_temporary,
                        "keep what Blender was given and returned");
  return [command, run_command, flags] {
    if (!command->got_subcommand(run_command))
      fail(ExitCode::usage, "rnmbake task needs a word: run; see 'rnmbake task --help'");
    StopRequest::install();
    return run(*flags);
  };
}

std::function<int()> add_status_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("status", "Say how far the tasks of a plan are");
  auto folder = std::make_shared<std::filesystem::path>();
  command->add_option("PLAN", *folder, "folder of a plan, or the output folder that it lies in")->required();
  return [folder] { return show(read_farm_plan(*folder)); };
}

}  // namespace rnmbake
