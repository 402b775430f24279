#include "base/error.h"
#include "base/text.h"
#include "cli/farm/farm.h"
#include "pipeline/farm/task_result.h"

#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

namespace rnmbake {
namespace {

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

std::function<int()> add_status_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("status", "Say how far the tasks of a plan are");
  auto folder = std::make_shared<std::filesystem::path>();
  command->add_option("PLAN", *folder, "folder of a plan, or the output folder that it lies in")->required();
  return [folder] { return show(read_farm_plan(*folder)); };
}

}  // namespace rnmbake
