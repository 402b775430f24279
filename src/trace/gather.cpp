#include "trace/gather.h"

#include "trace/gather_job.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

constexpr std::size_t texels_at_once = 1 << 17;  // of a group of targets

/// Adds up finished work and reports progress, one thread at a time.
class Reporter {
 public:
  Reporter(double total, const std::function<void(const GatherProgress&)>& say) : total_(total), say_(say) {}
  void advance(double work, std::size_t target) {
    if (!say_) return;
    const std::lock_guard lock(mutex_);
    done_ += work;
    say_({std::min(1.0, done_ / total_), target});
  }

 private:
  std::mutex mutex_;
  double total_, done_ = 0;
  const std::function<void(const GatherProgress&)>& say_;
};

/// A few targets gathered together, so that small ones leave no core idle.
class Group {
 public:
  Group(std::vector<std::unique_ptr<GatherJob>> jobs, const GatherOptions& options, Reporter& reporter,
        const std::function<bool()>& stop)
      : jobs_(std::move(jobs)), options_(options), reporter_(reporter), stop_(stop) {}

  /// False where it was stopped.
  bool run() {
    if (options_.error > 0) return run_to_error();
    for (const auto& job : jobs_) {
      for (TexelBlock& block : job->blocks()) job->plan(block, options_.samples);
    }
    return work(1, 1);
  }
  std::vector<std::unique_ptr<GatherJob>>& jobs() { return jobs_; }

 private:
  bool run_to_error() {
    for (const auto& job : jobs_) {
      for (TexelBlock& block : job->blocks()) {
        block.batch_samples = 1;
        block.batches = pilot_samples;
      }
    }
    if (!work(0, 0.1)) return false;
    for (const auto& job : jobs_) job->plan_for_error();
    if (!work(1, 0.8)) return false;
    for (bool more = true; more;) {
      more = false;
      for (const auto& job : jobs_) more |= job->plan_more();
      if (more && !work(1, 0.02)) return false;
    }
    return true;
  }

  /// `weight`: of this stage in the progress of the group.
  bool work(std::uint64_t stage, double weight) {
    struct Task {
      GatherJob* job;
      TexelBlock* block;
    };
    std::vector<Task> tasks;
    for (const auto& job : jobs_) {
      for (TexelBlock& block : job->blocks()) tasks.push_back({job.get(), &block});
    }
    std::atomic<bool> stopped = false;
    tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t i) {
      if (stopped) return;
      const Task& task = tasks[i];
      task.job->work(*task.block, stage, [&](double share) {
        reporter_.advance(weight * share * double(task.block->count), task.job->index());
        if (stop_ && stop_()) stopped = true;
        return !stopped;
      });
    });
    return !stopped;
  }

  std::vector<std::unique_ptr<GatherJob>> jobs_;
  const GatherOptions& options_;
  Reporter& reporter_;
  const std::function<bool()>& stop_;
};

using Done = std::function<void(std::size_t, Gathered&&)>;
using Say = std::function<void(const GatherProgress&)>;
using Stop = std::function<bool()>;

/// False where it was stopped.
bool gather_once(const TraceScene& scene, std::span<const GatherTarget> targets, const GatherOptions& options,
                 const Done& done, const Say& say, const Stop& stop) {
  double total = 0;  // texels, covered or not: coverage is known target by target
  for (const GatherTarget& target : targets) total += double(target.width) * target.height;
  Reporter reporter(std::max(1.0, total), say);
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  for (std::size_t next = 0; next < targets.size();) {
    std::vector<std::unique_ptr<GatherJob>> jobs;
    double uncovered = 0;
    for (std::size_t size = 0; next < targets.size() && size < texels_at_once; ++next) {
      const GatherTarget& target = targets[next];
      jobs.push_back(std::make_unique<GatherJob>(scene, next, target, options));
      size += jobs.back()->texels();
      uncovered += double(target.width) * target.height - double(jobs.back()->texels());
    }
    reporter.advance(uncovered, next - 1);
    Group group(std::move(jobs), options, reporter, stop);
    if (!arena.execute([&] { return group.run(); })) return false;
    for (const auto& job : group.jobs()) done(job->index(), job->result());
  }
  return true;
}

/// Gathers each direction apart: with self-reflection the incident radiance depends on the basis vector.
void gather_each(const TraceScene& scene, std::span<const GatherTarget> targets, const GatherOptions& options,
                 const Done& done, const Say& say, const Stop& stop) {
  std::vector<Gathered> results(targets.size());
  for (std::size_t k = 0; k < options.directions.size(); ++k) {
    GatherOptions one = options;
    one.directions = {options.directions[k]};
    one.sh_order = 0;
    if (one.faults.tilt_clamp) one.reuse = false;  // reflected radiance depends on the direction
    const auto merge = [&](std::size_t target, Gathered&& gathered) {
      Gathered& result = results[target];
      gathered.directions.insert(gathered.directions.begin(),
                                 std::make_move_iterator(result.directions.begin()),
                                 std::make_move_iterator(result.directions.end()));
      gathered.paths += result.paths;
      gathered.rays += result.rays;
      result = std::move(gathered);
    };
    const auto say_part = [&](const GatherProgress& progress) {
      say({(double(k) + progress.share) / double(options.directions.size()), progress.target});
    };
    if (!gather_once(scene, targets, one, merge, say ? Say(say_part) : Say(), stop)) return;
  }
  for (std::size_t i = 0; i < results.size(); ++i) done(i, std::move(results[i]));
}

}  // namespace

void gather(const TraceScene& scene, std::span<const GatherTarget> targets, const GatherOptions& options,
            const std::function<void(std::size_t, Gathered&&)>& done,
            const std::function<void(const GatherProgress&)>& progress, const std::function<bool()>& stop) {
  if (options.faults.self_reflection) {
    gather_each(scene, targets, options, done, progress, stop);
  } else {
    gather_once(scene, targets, options, done, progress, stop);
  }
}

}  // namespace rnmbake
