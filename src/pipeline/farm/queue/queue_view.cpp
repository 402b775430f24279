#include "pipeline/farm/queue/queue_view.h"

#include <algorithm>
#include <set>

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {

QueueView view_of(const std::vector<SlurmJob>& jobs) {
  QueueView view;
  std::set<std::string> nodes;
  for (const SlurmJob& job : jobs) {
    if (!job.is_alive()) {
      ++view.ended;
    } else if (job.nodes.empty()) {
      ++view.waiting;
    } else {
      ++view.running;
      nodes.insert(job.nodes);
    }
    if (job.is_held() && view.held.empty())
      view.held = fmt::format("{}{}: {}", job.id, job.index ? fmt::format("_{}", *job.index) : "",
                              job.reason.empty() ? job.state : job.reason);
  }
  view.nodes.assign(nodes.begin(), nodes.end());
  return view;
}

std::string describe(const QueueView& view) {
  std::string text = fmt::format("Slurm: {} running", view.running);
  if (!view.nodes.empty()) text += fmt::format(" on {}", fmt::join(view.nodes, ", "));
  text += fmt::format("; {} waiting; {} ended", view.waiting, view.ended);
  if (!view.held.empty()) text += "; held: " + view.held;
  return text;
}

std::vector<std::string> ended_without_result(const FarmPlan& plan, const PlanJobs& jobs,
                                              const std::vector<SlurmJob>& seen,
                                              const std::map<std::size_t, TaskResult>& results) {
  std::vector<std::string> lines;
  for (const SlurmJob& job : seen) {
    if (job.is_alive()) continue;
    const auto whole = std::ranges::find(jobs.arrays, job.index ? "" : job.id, &JobArray::id);
    if (whole != jobs.arrays.end())  // what of an array had not begun
      lines.push_back(fmt::format("tasks {} to {}, what had not begun of them: {}", whole->first,
                                  whole->first + whole->count - 1, job.state));
    const auto task = jobs.task_of(job);
    if (!task || results.contains(*task)) continue;
    lines.push_back(fmt::format("task {}: {}{}, {}", *task, job.state,
                                job.nodes.empty() ? "" : " on " + job.nodes, log_of(plan, job).string()));
  }
  return lines;
}

}  // namespace rnmbake
