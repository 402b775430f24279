#include "pipeline/farm/task_result.h"

#include "base/files.h"
#include "base/json.h"

#include <algorithm>
#include <cstdlib>

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path task_file(const FarmPlan& plan, std::size_t task, const char* ending) {
  return plan.folder / "tasks" / fmt::format("{}.{}", task, ending);
}

/// Null where there is none of this plan's.
json json_of_plan(const FarmPlan& plan, const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return nullptr;
  const json text = json_or_null(read_tail(file, 1 << 20));
  return text.is_object() && text.value("plan", json()) == plan.id ? text : json();
}

std::optional<TaskResult> result_of(const json& text) {
  if (text.is_null()) return std::nullopt;
  try {
    TaskResult result{{}, text.at("seconds"), text.at("host"), text.at("launches")};
    for (const json& one : text.at("failed")) result.failed.push_back({one.at("object"), one.at("reason")});
    return result;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

}  // namespace

void write_task_result(const FarmPlan& plan, std::size_t task, const TaskResult& result) {
  json failed = json::array();
  for (const FailedObject& one : result.failed)
    failed.push_back({{"object", one.object}, {"reason", one.reason}});
  const json text{{"plan", plan.id},
                  {"task", task},
                  {"outcome", result.failed.empty() ? "done" : "failed"},
                  {"failed", failed},
                  {"seconds", result.seconds},
                  {"host", result.host},
                  {"launches", result.launches}};
  make_folders(plan.folder / "tasks");
  write_atomically(task_file(plan, task, "json"),
                   text.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
}

std::map<std::size_t, TaskResult> read_task_results(const FarmPlan& plan) {
  return new_task_results(plan, {});
}

std::map<std::size_t, TaskResult> new_task_results(const FarmPlan& plan,
                                                   const std::map<std::size_t, TaskResult>& known) {
  std::map<std::size_t, TaskResult> results;
  std::error_code error;
  // The folder is listed: over NFS that finds files which were not there at the last look.
  for (fs::directory_iterator at(plan.folder / "tasks", error), end; !error && at != end;
       at.increment(error)) {
    const std::size_t task = std::strtoull(at->path().stem().c_str(), nullptr, 10);
    if (task >= plan.tasks.size() || known.contains(task) || at->path() != task_file(plan, task, "json"))
      continue;
    if (auto result = result_of(json_of_plan(plan, at->path()))) results[task] = std::move(*result);
  }
  return results;
}

void note_task_begun(const FarmPlan& plan, std::size_t task) {
  make_folders(plan.folder / "tasks");
  write_atomically(task_file(plan, task, "begun"),
                   json{{"plan", plan.id}, {"host", host_name()}}.dump() + "\n");
}

bool has_begun(const FarmPlan& plan, std::size_t task) {
  return !json_of_plan(plan, task_file(plan, task, "begun")).is_null();
}

void note_merged(const FarmPlan& plan, const MergeResult& result) {
  const json text{{"plan", plan.id}, {"exit_code", result.exit_code}, {"error", result.error}};
  write_atomically(plan.folder / "merged.json",
                   text.dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
}

std::optional<MergeResult> merged(const FarmPlan& plan) {
  const json text = json_of_plan(plan, plan.folder / "merged.json");
  if (text.is_null() || !text.value("exit_code", json()).is_number_integer()) return std::nullopt;
  const json error = text.value("error", json());
  return MergeResult{text.at("exit_code"), error.is_string() ? error.get<std::string>() : ""};
}

std::string why_missing(const FarmPlan& plan, const std::map<std::size_t, TaskResult>& results,
                        const std::string& object) {
  std::string general;
  for (const auto& [task, result] : results) {
    for (const FailedObject& one : result.failed) {
      if (one.object == object) return fmt::format("{} (task {} on {})", one.reason, task, result.host);
      if (one.object.empty())
        general = fmt::format("task {} failed on {}: {}", task, result.host, one.reason);
    }
  }
  if (!general.empty()) return general;
  for (std::size_t task = 0; task < plan.tasks.size(); ++task) {
    if (results.contains(task)) continue;
    for (const FarmShare& share : plan.tasks[task].shares) {
      const auto& objects = plan.batches[share.batch].objects;
      if (std::ranges::find(objects, object) == objects.end()) continue;
      return fmt::format("task {} has left no result; run it: rnmbake task run --plan {} --index {}", task,
                         plan.folder.string(), task);
    }
  }
  return "passes of it are not in the cache any more; run the tasks again, or rnmbake bake";
}

std::string host_name() {
  if (const char* node = std::getenv("SLURMD_NODENAME")) return node;
  char name[256] = {};
  (void)::gethostname(name, sizeof name - 1);
  return name;
}

}  // namespace rnmbake
