#include "trace/gather.h"

#include "trace/block.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

constexpr int wanted_batches = 16;
constexpr int pilot_samples = 16;                // to learn how noisy a block is
constexpr std::size_t texels_at_once = 1 << 17;  // of targets that are worked on together

/// A block of texels, and all that is known of it.
struct Block {
  std::size_t first = 0, count = 0;  // in Sites::texels()
  int batch_samples = 1, batches = 0;
  std::unique_ptr<BatchTally> tally;
  std::int64_t rays = 0;
  std::vector<std::int64_t> back_faces;

  [[nodiscard]] std::int64_t samples() const { return std::int64_t(tally->batches()) * batch_samples; }
};

/// One target at work.
class Job {
 public:
  Job(const TraceScene& scene, std::size_t index, const GatherTarget& target, const GatherOptions& options)
      : scene_(scene),
        index_(index),
        target_(target),
        options_(options),
        sites_(*target.surface, target.width, target.height, options.footprint, options.past_edge) {
    if (options.faults.any()) own_.emplace(scene, target);
    for (std::size_t first = 0; first < texels(); first += BlockGatherer::texels) {
      blocks_.push_back({first, std::min(BlockGatherer::texels, texels() - first), 1, 0, {}, 0, {}});
    }
  }

  [[nodiscard]] std::size_t index() const { return index_; }
  [[nodiscard]] std::size_t texels() const { return sites_.texels().size(); }
  std::vector<Block>& blocks() { return blocks_; }

  /// Takes a block as far as its plan says. `stage` separates the noise of the pilot from what counts.
  /// `go_on` is asked after each batch, with the share of this work that the batch was.
  void work(Block& block, std::uint64_t stage, const std::function<bool(double)>& go_on) const {
    BlockGatherer gatherer(scene_, sites_, options_, own_ ? &*own_ : nullptr);
    if (!block.tally) block.tally = std::make_unique<BatchTally>(block.count, gatherer.values());
    const std::uint64_t seed = hash_of(hash_of(hash_of(options_.seed, index_), stage), block.first);
    const std::span texels(&sites_.texels()[block.first], block.count);
    const double share = 1.0 / std::max(1, block.batches - block.tally->batches());
    while (block.tally->batches() < block.batches) {
      const auto number = static_cast<std::uint64_t>(block.tally->batches());
      gatherer.batch(texels, block.batch_samples, hash_of(seed, number), *block.tally);
      if (!go_on(share)) return;
    }
    block.rays += gatherer.rays();
    block.back_faces.resize(block.count);
    for (std::size_t i = 0; i < block.count; ++i) block.back_faces[i] += gatherer.back_faces()[i];
  }

  void plan(Block& block, std::int64_t samples) const {
    const std::int64_t wanted = std::clamp<std::int64_t>(samples, 1, options_.samples);
    block.batch_samples = static_cast<int>(std::max<std::int64_t>(1, wanted / wanted_batches));
    block.batches = static_cast<int>((wanted + block.batch_samples - 1) / block.batch_samples);
  }

  /// From a pilot: samples for each block so that the fewest in all give the error asked for (Neyman 1934).
  void plan_for_error() {
    const std::vector<double> means = direction_means();
    std::vector<double> noise;  // of one sample, over the mean of its direction: the worst direction's
    double sum = 0;
    for (const Block& block : blocks_) {
      double square = 0;
      for (std::size_t k = 0; k < means.size(); ++k)
        square = std::max(square, relative_square(block, k, means[k]));
      noise.push_back(std::sqrt(square / double(block.count) * double(block.samples())));
      sum += noise.back() * double(block.count);
    }
    const double wanted = sum / (covered() * options_.error * options_.error);
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      blocks_[b].tally.reset();
      plan(blocks_[b], std::max<std::int64_t>(pilot_samples, std::llround(std::ceil(noise[b] * wanted))));
    }
  }

  /// False where the error asked for is reached, or as many samples as allowed were taken.
  bool plan_more() {
    const double ratio = relative_error() / options_.error;
    if (!(ratio > 1)) return false;
    bool more = false;
    for (Block& block : blocks_) {
      const auto most = static_cast<int>(options_.samples / block.batch_samples);
      const int batches = std::min(most, static_cast<int>(std::ceil(block.batches * ratio * ratio * 1.05)));
      more |= batches > block.batches;
      block.batches = std::max(block.batches, batches);
    }
    return more;
  }

  Gathered result() const {
    Gathered out;
    const auto image = [&](int channels) { return FloatImage(target_.width, target_.height, channels); };
    out.coverage = image(1);
    out.validity = image(1);
    out.directions.resize(options_.directions.size());
    for (GatheredDirection& direction : out.directions) {
      direction.radiance = image(3);
      direction.standard_error = image(3);
    }
    for (int c = 0; c < options_.sh_order * options_.sh_order; ++c) out.sh.push_back(image(3));
    for (const Block& block : blocks_) write(block, out);
    for (GatheredDirection& direction : out.directions) {
      for (double& error : direction.mean_error) error = std::sqrt(error);
    }
    return out;
  }

 private:
  void write(const Block& block, Gathered& out) const {
    const auto put = [](FloatImage& image, const TexelSite& site, const Vec3& value) {
      std::copy_n(&value.x, 3, image.texel(site.x, site.y).begin());
    };
    out.paths += block.samples() * std::int64_t(block.count);
    out.rays += block.rays;
    for (std::size_t i = 0; i < block.count; ++i) {
      const TexelSite& site = sites_.texels()[block.first + i];
      out.coverage.texel(site.x, site.y)[0] = 1;
      out.validity.texel(site.x, site.y)[0] =
          1 - static_cast<float>(double(block.back_faces[i]) / double(block.samples()));
      for (std::size_t k = 0; k < out.directions.size(); ++k) {
        const Vec3 square = block.tally->squared_error(i, k);
        put(out.directions[k].radiance, site, block.tally->mean(i, k));
        put(out.directions[k].standard_error, site,
            {std::sqrt(square.x), std::sqrt(square.y), std::sqrt(square.z)});
      }
      for (std::size_t c = 0; c < out.sh.size(); ++c) {
        put(out.sh[c], site, block.tally->mean(i, out.directions.size() + c));
      }
    }
    const double share = double(block.count) / covered();
    for (std::size_t k = 0; k < out.directions.size(); ++k) {
      const Vec3 mean = block.tally->whole_mean(k), square = block.tally->whole_squared_error(k);
      for (int c = 0; c < 3; ++c) {
        out.directions[k].mean[c] += share * mean[c];
        out.directions[k].mean_error[c] += share * share * square[c];  // squared until all blocks are in
      }
    }
  }

  [[nodiscard]] double covered() const { return std::max(1.0, double(texels())); }

  [[nodiscard]] std::vector<double> direction_means() const {
    std::vector<double> means(options_.directions.size());
    for (const Block& block : blocks_) {
      for (std::size_t k = 0; k < means.size(); ++k) {
        const Vec3 mean = block.tally->whole_mean(k);
        means[k] += double(mean.x + mean.y + mean.z) / 3 * double(block.count) / covered();
      }
    }
    return means;
  }

  /// Sum over texels of the squared standard error (mean over colours), over the squared mean of the
  /// direction.
  [[nodiscard]] static double relative_square(const Block& block, std::size_t k, double mean) {
    double sum = 0;
    for (std::size_t i = 0; i < block.count; ++i) {
      const Vec3 square = block.tally->squared_error(i, k);
      sum += double(square.x + square.y + square.z) / 3;
    }
    return mean > 0 ? sum / (mean * mean) : 0;
  }

  /// RMS over texels, of the direction where it is largest.
  [[nodiscard]] double relative_error() const {
    const std::vector<double> means = direction_means();
    double worst = 0;
    for (std::size_t k = 0; k < means.size(); ++k) {
      double sum = 0;
      for (const Block& block : blocks_) sum += relative_square(block, k, means[k]);
      worst = std::max(worst, sum / covered());
    }
    return std::sqrt(worst);
  }

  const TraceScene& scene_;
  std::size_t index_;
  const GatherTarget& target_;
  const GatherOptions& options_;
  Sites sites_;
  std::optional<OwnSurface> own_;
  std::vector<Block> blocks_;
};

/// Counts finished samples and says so, one thread at a time.
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

/// A few targets, worked on together so that small ones leave no core idle.
class Group {
 public:
  Group(std::vector<std::unique_ptr<Job>> jobs, const GatherOptions& options, Reporter& reporter,
        const std::function<bool()>& stop)
      : jobs_(std::move(jobs)), options_(options), reporter_(reporter), stop_(stop) {}

  /// False where it was stopped.
  bool run() {
    if (options_.error > 0) return run_to_error();
    for (const auto& job : jobs_) {
      for (Block& block : job->blocks()) job->plan(block, options_.samples);
    }
    return work(1, 1);
  }
  std::vector<std::unique_ptr<Job>>& jobs() { return jobs_; }

 private:
  bool run_to_error() {
    for (const auto& job : jobs_) {
      for (Block& block : job->blocks()) {
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
      Job* job;
      Block* block;
    };
    std::vector<Task> tasks;
    for (const auto& job : jobs_) {
      for (Block& block : job->blocks()) tasks.push_back({job.get(), &block});
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

  std::vector<std::unique_ptr<Job>> jobs_;
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
  double total = 0;  // texels, about: which of them are covered is found out target by target
  for (const GatherTarget& target : targets) total += double(target.width) * target.height;
  Reporter reporter(std::max(1.0, total), say);
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  for (std::size_t next = 0; next < targets.size();) {
    std::vector<std::unique_ptr<Job>> jobs;
    double uncovered = 0;
    for (std::size_t size = 0; next < targets.size() && size < texels_at_once; ++next) {
      const GatherTarget& target = targets[next];
      jobs.push_back(std::make_unique<Job>(scene, next, target, options));
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

/// With self-reflection the light itself depends on the basis vector: one pass for each.
void gather_each(const TraceScene& scene, std::span<const GatherTarget> targets, const GatherOptions& options,
                 const Done& done, const Say& say, const Stop& stop) {
  std::vector<Gathered> results(targets.size());
  for (std::size_t k = 0; k < options.directions.size(); ++k) {
    GatherOptions one = options;
    one.directions = {options.directions[k]};
    one.sh_order = 0;
    if (one.faults.tilt_clamp) one.reuse = false;  // then what a place sends back depends on who looks
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
