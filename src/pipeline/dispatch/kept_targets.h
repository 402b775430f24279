// pipeline/dispatch/kept_targets.h - targets of a plan that were baked before, and the rest in batches.
#pragma once

#include "bake/plan.h"
#include "pipeline/dispatch/batch_work.h"
#include "pipeline/dispatch/pass_cache.h"
#include "pipeline/dispatch/picture_sink.h"

#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

namespace rnmbake {

/// Tasks that are to be baked together, going on from the same number of samples.
struct MissingBatch {
  Batch batch;
  HalfSamples done{0, 0};
  std::vector<SamplePass> passes = {};  // just these of its passes; none: all that lead to its samples
};

/// Thread-safe but for missing().
class KeptTargets {
 public:
  using Cut = std::function<std::vector<Batch>(const Batch&)>;

  KeptTargets(const Plan& plan, const PassCache& cache, PictureSink& sink);

  /// Hands what the cache holds of the plan to the sink, and says what is missing: the batches of the plan
  /// without it, cut by `cut`. A run after one that was killed gets the batches that that one had, so that
  /// its result is the same to the last digit.
  [[nodiscard]] std::vector<MissingBatch> missing(const Cut& cut);

  /// Pictures that a batch goes on from.
  [[nodiscard]] EarlierPictures earlier(const MissingBatch& batch) const;

  /// Keeps the targets that the pictures complete. `in_time`: they have what samples there was time for.
  void keep(const BatchLayout& layout, const std::vector<BakedPicture>& pictures, bool in_time);

  /// At the end of a run.
  void forget_journal() const;

 private:
  void hand_over(std::size_t target, TargetPictures pictures);
  [[nodiscard]] std::optional<TargetPictures> find(std::size_t target, int samples) const;

  const Plan& plan_;
  const PassCache& cache_;
  PictureSink& sink_;
  std::vector<PlannedTarget> targets_;
  std::vector<ResultKey> keys_;  // [targets]; none without a cache
  ResultKey run_;
  std::mutex mutex_;
  std::map<std::size_t, std::map<std::size_t, BakedPicture>> parts_;  // target -> rectangle -> picture
};

}  // namespace rnmbake
