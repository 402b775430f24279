#include "pipeline/farm/queue/wait_merge.h"

#include "base/error.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/text.h"
#include "pipeline/farm/queue/patience.h"
#include "pipeline/farm/queue/queue_view.h"
#include "pipeline/farm/task_result.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace rnmbake {
namespace {

class MergeWait {
 public:
  MergeWait(const FarmPlan& plan, const PlanJobs& jobs, const Slurm& slurm, const WaitPauses& pauses)
      : plan_(plan),
        jobs_(jobs),
        slurm_(slurm),
        pauses_(pauses),
        progress_("farm", progress_for(log::is_quiet(), log::is_jsonl())) {
    for (const FarmTask& task : plan.tasks) all_ += task.seconds;
  }

  int to_the_end() {
    for (;;) {
      take_results();
      if (const auto result = merged(plan_)) return report(*result);
      if (next_look_.is_over()) ask();
      Patience::sleep(pauses_.files);
    }
  }

 private:
  /// New results only: there may be thousands.
  void take_results() {
    for (auto& [task, result] : new_task_results(plan_, results_)) {
      for (const FailedObject& one : result.failed)
        log::error("{}{} (task {} on {})", one.object.empty() ? "" : printable(one.object) + ": ",
                   printable(one.reason), task, result.host);
      done_ += plan_.tasks[task].seconds;
      results_[task] = std::move(result);
    }
    const double share = all_ > 0 ? done_ / all_ : 1;
    progress_.update(
        share, fmt::format("{} of {}{}", results_.size(), counted(plan_.tasks.size(), "task"), queue_words_));
  }

  /// Asks at first often, later rarely: a controller serves many.
  void ask() {
    pause_ = std::min(1.5 * pause_, pauses_.queue);
    next_look_ = Patience(pause_);
    const auto seen = slurm_.jobs_named(jobs_.name);
    throw_if_stopped();
    if (!seen) {
      if (!std::exchange(is_silent_, true))
        log::warn("Slurm does not answer; its files go on being watched, and it is asked again");
      is_gone_ = false;
      return;
    }
    if (std::exchange(is_silent_, false)) log::info("Slurm answers again");
    const QueueView view = view_of(*seen);
    queue_words_ = fmt::format("; {} running, {} waiting", view.running, view.waiting);
    if (view.held != held_ && !view.held.empty())
      log::warn("a job is held and waits for somebody (scontrol release): {}", view.held);
    held_ = view.held;
    if (view.is_anything_alive()) {
      is_gone_ = false;
    } else if (std::exchange(is_gone_, true)) {
      give_up(*seen);
    } else {  // its files may still be on their way
      next_look_ = Patience(pauses_.until_sure);
    }
  }

  [[noreturn]] void give_up(const std::vector<SlurmJob>& seen) {
    for (const std::string& line : ended_without_result(plan_, jobs_, seen, results_)) log::error("{}", line);
    const auto now = read_jobs(plan_.folder);
    const std::string what = now && now->cancelled ? "was cancelled" : "has no job in Slurm any more";
    fail(
        ExitCode::io,
        "{} {}, and nothing was merged; {} of {} left a result, the logs are in {}. Submit again: what is in "
        "the cache is not baked again",
        plan_.folder.string(), what, results_.size(), counted(plan_.tasks.size(), "task"),
        (plan_.folder / "slurm").string());
  }

  int report(const MergeResult& result) {
    if (!result.error.empty()) {
      log::error("the merge failed: {}", printable(result.error));
    } else if (result.exit_code != 0) {
      log::warn("merged, with exit code {}: some objects failed; the others were delivered",
                result.exit_code);
    } else {
      log::info("merged: {}", plan_.output.string());
    }
    return result.exit_code;
  }

  const FarmPlan& plan_;
  const PlanJobs& jobs_;
  const Slurm& slurm_;
  WaitPauses pauses_;
  Progress progress_;
  std::map<std::size_t, TaskResult> results_;
  double all_ = 0, done_ = 0;  // predicted seconds
  std::string queue_words_, held_;
  double pause_ = 2;
  Patience next_look_{0};
  bool is_silent_ = false, is_gone_ = false;
};

}  // namespace

int wait_for_merge(const FarmPlan& plan, const PlanJobs& jobs, const Slurm& slurm, const WaitPauses& pauses) {
  return MergeWait(plan, jobs, slurm, pauses).to_the_end();
}

}  // namespace rnmbake
