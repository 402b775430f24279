// pipeline/farm/task_result.h - what became of each task: files that are the truth, whatever a queue says.
#pragma once

#include "pipeline/farm/farm_plan.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

struct FailedObject {
  std::string object;  // key; "": what failed names none, so all of its objects lack passes
  std::string reason;
};

struct TaskResult {
  std::vector<FailedObject> failed;  // none: done
  double seconds = 0;
  std::string host;
  int launches = 0;
};

/// tasks/N.json, whole or not at all.
void write_task_result(const FarmPlan& plan, std::size_t task, const TaskResult& result);

/// Of this plan, by task. What cannot be read, or is another plan's, is not there.
[[nodiscard]] std::map<std::size_t, TaskResult> read_task_results(const FarmPlan& plan);

/// Those that are not among the known ones.
[[nodiscard]] std::map<std::size_t, TaskResult> new_task_results(
    const FarmPlan& plan, const std::map<std::size_t, TaskResult>& known);

/// tasks/N.begun: somebody runs it, or ran it when he was killed.
void note_task_begun(const FarmPlan& plan, std::size_t task);
[[nodiscard]] bool has_begun(const FarmPlan& plan, std::size_t task);

/// How the bake that merges ended.
struct MergeResult {
  int exit_code = 0;
  std::string error;  // that ended it as a whole
};

/// merged.json.
void note_merged(const FarmPlan& plan, const MergeResult& result);
[[nodiscard]] std::optional<MergeResult> merged(const FarmPlan& plan);

/// Why an object lacks passes, with what to do about it.
[[nodiscard]] std::string why_missing(const FarmPlan& plan, const std::map<std::size_t, TaskResult>& results,
                                      const std::string& object);

/// Of this machine, as its queue calls it where one started us.
[[nodiscard]] std::string host_name();

}  // namespace rnmbake
