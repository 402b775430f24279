#include "trace/gather.h"

#include "trace/gather_job.h"

#include <algorithm>
#include <atomic>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

constexpr std::size_t texels_at_once = 1 << 17;   // of a group of targets
constexpr double share_worth_keeping = 1.0 / 16;  // of a part: less is as soon gathered again

/// Adds up finished work and reports progress, one thread at a time.
class Reporter {
 public:
  Reporter(double total, const std::function<void(const GatherProgress&)>& say) : total_(total), say_(say) {}
  void advance(double work, std::size_t target) {
    if (!say_) return;
    const std::lock_guard lock(mutex_);
    done_ += work;
    say_({std::min(1.0, done_ / std::max(1.0, total_)), target});
  }
  /// Work that need not be done.
  void leave_out(double work) {
    const std::lock_guard lock(mutex_);
    total_ -= work;
  }

 private:
  std::mutex mutex_;
  double total_, done_ = 0;
  const std::function<void(const GatherProgress&)>& say_;
};

/// What is kept of one gathering.
struct KeptParts {
  GatherStore* store = nullptr;
  int direction = GatherPart::all_directions;

  [[nodiscard]] bool restore(GatherJob& job, int round, std::size_t first, std::size_t count) const {
    if (store == nullptr) return false;
    const auto bytes = store->find({job.index(), direction, round, first, count});
    return bytes && job.restore(first, count, *bytes);
  }
  void keep(const GatherJob& job, int round, std::size_t first, std::size_t count) const {
    if (store != nullptr) store->keep({job.index(), direction, round, first, count}, job.state(first, count));
  }
  [[nodiscard]] bool restore(GatherJob& job) const {
    return restore(job, GatherPart::last_round, 0, job.blocks().size());
  }
  void keep(GatherJob& job) const { keep(job, GatherPart::last_round, 0, job.blocks().size()); }
};

/// A few targets gathered together, so that small ones leave no core idle.
class Group {
 public:
  Group(std::vector<std::unique_ptr<GatherJob>> jobs, const GatherOptions& options, Reporter& reporter,
        const std::function<bool()>& stop, const KeptParts& kept)
      : jobs_(std::move(jobs)), options_(options), reporter_(reporter), stop_(stop), kept_(kept) {}

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
    for (int round = 2;; ++round) {
      bool more = false;
      for (const auto& job : jobs_) more |= job->plan_more();
      if (!more) return true;
      if (!work(round, 0.02)) return false;
    }
  }

  /// Blocks that are kept when all of them are gathered.
  struct Part {
    Part(GatherJob& of, const BlockRange& blocks, int samples_round)
        : job(&of), range(blocks), round(samples_round), left(blocks.count) {}
    GatherJob* job;
    BlockRange range;
    int round;
    std::atomic<std::size_t> left;
  };
  struct Task {
    Part* part;
    TexelBlock* block;
  };

  /// `weight`: of this round in the progress of the group.
  bool work(int round, double weight) {
    const double paths_of_part =
        kept_.store != nullptr ? kept_.store->paths_of_part : std::numeric_limits<double>::infinity();
    std::deque<Part> parts;
    std::vector<Task> tasks;
    for (const auto& job : jobs_) {
      for (const BlockRange& range : job->missing(paths_of_part))
        add(*job, range, round, weight, parts, tasks);
    }
    const std::uint64_t stage = round == 0 ? 0 : 1;
    std::atomic<bool> stopped = false;
    tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t i) {
      if (stopped) return;
      Part& part = *tasks[i].part;
      part.job->work(*tasks[i].block, stage, [&](double share) {
        reporter_.advance(weight * share * double(tasks[i].block->count), part.job->index());
        if (stop_ && stop_()) stopped = true;
        return !stopped;
      });
      if (!stopped && --part.left == 0) finish(part);
    });
    return !stopped;
  }

  /// Adds a range to the work, unless it is kept.
  void add(GatherJob& job, const BlockRange& range, int round, double weight, std::deque<Part>& parts,
           std::vector<Task>& tasks) {
    const bool is_all = options_.error == 0 && range.count == job.blocks().size();
    if (is_all) round = GatherPart::last_round;
    if (!is_all && kept_.restore(job, round, range.first, range.count)) {
      double texels = 0;
      for (std::size_t b = range.first; b < range.first + range.count; ++b)
        texels += double(job.blocks()[b].count);
      return reporter_.leave_out(weight * texels);
    }
    Part& part = parts.emplace_back(job, range, round);
    for (std::size_t b = range.first; b < range.first + range.count; ++b)
      tasks.push_back({&part, &job.blocks()[b]});
  }

  void finish(const Part& part) const {
    if (kept_.store == nullptr) return;
    if (part.round == GatherPart::last_round ||
        part.range.paths >= share_worth_keeping * kept_.store->paths_of_part)
      kept_.keep(*part.job, part.round, part.range.first, part.range.count);
  }

  std::vector<std::unique_ptr<GatherJob>> jobs_;
  const GatherOptions& options_;
  Reporter& reporter_;
  const std::function<bool()>& stop_;
  const KeptParts& kept_;
};

using Done = std::function<void(std::size_t, Gathered&&)>;
using Say = std::function<void(const GatherProgress&)>;
using Stop = std::function<bool()>;

/// False where it was stopped.
bool gather_once(const TraceScene& scene, std::span<const GatherTarget> targets, const GatherOptions& options,
                 const Done& done, const Say& say, const Stop& stop, const KeptParts& kept) {
  double total = 0;  // texels, covered or not: coverage is known target by target
  for (const GatherTarget& target : targets) total += double(target.width) * target.height;
  Reporter reporter(total, say);
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  for (std::size_t next = 0; next < targets.size();) {
    std::vector<std::unique_ptr<GatherJob>> jobs;
    double uncovered = 0;
    for (std::size_t size = 0; next < targets.size() && size < texels_at_once; ++next) {
      const GatherTarget& target = targets[next];
      const double texels = double(target.width) * target.height;
      auto job = std::make_unique<GatherJob>(scene, next, target, options);
      if (kept.restore(*job)) {
        reporter.leave_out(texels);
        done(next, job->result());
        continue;
      }
      size += job->texels();
      uncovered += texels - double(job->texels());
      jobs.push_back(std::move(job));
    }
    reporter.advance(uncovered, next - 1);
    Group group(std::move(jobs), options, reporter, stop, kept);
    if (!arena.execute([&] { return group.run(); })) return false;
    for (const auto& job : group.jobs()) {
      kept.keep(*job);
      done(job->index(), job->result());
    }
  }
  return true;
}

/// Gathers each direction apart: with self-reflection the incident radiance depends on the basis vector.
void gather_each(const TraceScene& scene, std::span<const GatherTarget> targets, const GatherOptions& options,
                 const Done& done, const Say& say, const Stop& stop, GatherStore* store) {
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
      if (k + 1 == options.directions.size()) done(target, std::move(result));
    };
    const auto say_part = [&](const GatherProgress& progress) {
      say({(double(k) + progress.share) / double(options.directions.size()), progress.target});
    };
    const KeptParts kept{store, static_cast<int>(k)};
    if (!gather_once(scene, targets, one, merge, say ? Say(say_part) : Say(), stop, kept)) return;
  }
}

}  // namespace

void gather(const TraceScene& scene, std::span<const GatherTarget> targets, const GatherOptions& options,
            const std::function<void(std::size_t, Gathered&&)>& done,
            const std::function<void(const GatherProgress&)>& progress, const std::function<bool()>& stop,
            GatherStore* kept) {
  if (options.faults.self_reflection) {
    gather_each(scene, targets, options, done, progress, stop, kept);
  } else {
    gather_once(scene, targets, options, done, progress, stop, {kept});
  }
}

}  // namespace rnmbake
