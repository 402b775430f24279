#include "cli/farm/farm.h"

#include "base/error.h"
#include "base/log.h"
#include "base/text.h"
#include "cli/farm/queue.h"
#include "pipeline/farm/run_task.h"
#include "pipeline/farm/shared_folders.h"
#include "pipeline/farm/task_result.h"
#include "pipeline/run/result_store.h"
#include "process/stop.h"

#include <cerrno>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <unistd.h>

namespace rnmbake {
namespace {

struct TaskFlags {
  std::filesystem::path plan;
  std::string id;  // of the plan that a queue's job is for; "": whatever is there
  std::size_t index = 0;
  NodeSettings node;
};

/// What the queue gave this task; 0: nothing is known.
int threads_of_queue() {
  const char* text = std::getenv("SLURM_CPUS_PER_TASK");
  return text == nullptr ? 0 : std::max(0, std::atoi(text));
}

FarmPlan plan_of(const TaskFlags& flags) {
  return flags.id.empty() ? read_farm_plan(flags.plan) : read_shared_plan(flags.plan, flags.id);
}

int run(TaskFlags flags) {
  if (flags.node.threads == 0) flags.node.threads = threads_of_queue();
  const FarmPlan plan = plan_of(flags);
  flags.node.must_see_output = !flags.id.empty();
  const TaskResult result = run_task(plan, flags.index, flags.node);
  if (!result.failed.empty()) {
    log::warn("task {}: {} failed; the rest of it is in the cache", flags.index,
              counted(result.failed.size(), "object"));
    return static_cast<int>(ExitCode::tasks_failed);
  }
  log::info("task {} of {}: done in {:.1f} s", flags.index, plan.tasks.size(), result.seconds);
  return static_cast<int>(ExitCode::ok);
}

/// What must be so before anything is merged here.
void prepare_merge(const FarmPlan& plan, bool must_see_output) {
  if (must_see_output) require_shared_output(plan);
  const ResolvedConfig config = node_config(plan, {});
  Store store = open_store(config.globals);
  require_shared_cache(plan, store);
  std::error_code error;
  std::filesystem::current_path(plan.work_folder, error);
  if (error)
    fail(
        ExitCode::environment,
        "{} does not see the folder {} in which the plan was made: {}; submit again in one that all machines "
        "see",
        host_name(), plan.work_folder.string(), error.message());
}

/// Becomes the bake that merges, with its signals and its exit code.
[[noreturn]] void become_merge(const FarmPlan& plan) {
  std::vector<std::string> words{"rnmbake", "bake"};
  words.insert(words.end(), plan.merge.begin(), plan.merge.end());
  words.insert(words.end(), {"--merge", plan.folder.string()});
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  if (const int threads = threads_of_queue(); threads > 0)
    ::setenv("RNMBAKE_THREADS", std::to_string(threads).c_str(), 0);
  ::execv("/proc/self/exe", argv.data());
  fail(ExitCode::io, "rnmbake cannot start itself: {}", std::generic_category().message(errno));
}

int merge(const TaskFlags& flags) {
  const FarmPlan plan = plan_of(flags);
  try {
    prepare_merge(plan, !flags.id.empty());
    become_merge(plan);
  } catch (const Error& error) {
    note_merged(plan, {static_cast<int>(error.code()), error.what()});
    throw;
  }
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
  show_queue(plan, results);
  if (const auto result = merged(plan))
    std::cout << fmt::format("merged, with exit code {}{}\n", result->exit_code,
                             result->error.empty() ? "" : ": " + printable(result->error));
  return static_cast<int>(ExitCode::ok);
}

}  // namespace

std::function<int()> add_task_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("task", "Run a task of a plan that rnmbake submit made, or its merge");
  command->require_subcommand(0, 1);
  CLI::App* run_command = command->add_subcommand("run", "bake the passes of a task that the cache lacks");
  auto flags = std::make_shared<TaskFlags>();
  CLI::App* merge_command =
      command->add_subcommand("merge", "bake --merge as submit printed it, in its folder");
  for (CLI::App* one : {run_command, merge_command}) {
    one->add_option("--plan", flags->plan, "folder of the plan")->type_name("PATH")->required();
    one->add_option("--id", flags->id,
                    "of the plan that is meant; this machine must see it and its output folder")
        ->type_name("ID");
  }
  run_command->add_option("--index", flags->index, "which task, from 0")->type_name("N")->required();
  run_command->add_option("--blender", flags->node.blender, "Blender of this machine, of the same build")
      ->type_name("PROGRAM");
  run_command->add_option("--threads", flags->node.threads, "threads of Blender")
      ->type_name("N")
      ->check(CLI::Range(0, 1024).description(""));
  run_command->add_flag("--keep-temporary", flags->node.keep_temporary,
                        "keep what Blender was given and returned");
  return [command, run_command, merge_command, flags] {
    if (command->got_subcommand(merge_command)) return merge(*flags);
    if (!command->got_subcommand(run_command))
      fail(ExitCode::usage, "rnmbake task needs a word: run or merge; see 'rnmbake task --help'");
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
