// pipeline/dispatch/batch_work.h - one batch on its way: its passes, which of them are there, and their mean.
#pragma once

#include "bake/baked_picture.h"
#include "bake/plan.h"
#include "bake/request.h"
#include "bake/sample_passes.h"
#include "base/clock.h"
#include "pipeline/dispatch/pass_cache.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

namespace rnmbake {

/// Pictures that a batch goes on from, by atlas rectangle; none: from nothing.
using EarlierPictures = std::map<std::size_t, BakedPicture>;

/// A batch of which another one is a piece: where its passes lie in the cache, with which rectangles.
struct WholeBatch {
  ResultKey request;
  std::vector<std::size_t> rects;  // in its layout's order
};

/// Passes are taken in strictly in order, wherever they come from, so that the mean is the same to the last
/// digit.
class BatchWork {
 public:
  struct Rules {
    bool whole = false;  // the recipe cannot bake a part of its samples
    bool halves = true;
    PassCost cost;
    std::optional<double> deadline;  // on the clock; then the best that fits
    const Clock* clock = &steady_clock();
    std::vector<SamplePass> only = {};    // these passes alone; none: all
    std::vector<WholeBatch> wholes = {};  // whose passes count as its own, the largest first
  };

  /// `request` and its arrays in `folder`. Where an error or a time decides how long to go on, passes are
  /// planned round by round.
  BatchWork(const Plan& plan, Batch batch, BakeRequest request, std::filesystem::path folder,
            const Rules& rules, const EarlierPictures& earlier, const PassCache& cache);

  [[nodiscard]] const Batch& batch() const { return batch_; }
  [[nodiscard]] const BatchLayout& layout() const { return request_.layout; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  /// The request with the passes that are missing.
  [[nodiscard]] nlohmann::json launch_request() const;

  /// Takes in what the cache holds of the next passes.
  void take_kept();

  /// Takes in what a launch has finished so far: reads the files of passes, keeps them in the cache. Answers
  /// a launch that waits. Throws Error(tasks_failed) for a picture that is
  /// not whole.
  void take_finished(bool keep_files);

  [[nodiscard]] bool is_complete() const { return next_ == passes_.size(); }
  /// Passes that are there, and the samples that one of them takes.
  [[nodiscard]] std::size_t passes_done() const { return next_; }

  /// All passes in their order with their keys, those that are missing, and what a piece looks its own up by.
  [[nodiscard]] const std::vector<SamplePass>& passes() const { return passes_; }
  [[nodiscard]] ResultKey key_of(std::size_t pass) const;
  [[nodiscard]] std::vector<SamplePass> passes_left() const;
  [[nodiscard]] WholeBatch as_whole() const { return {key_, layout().rects}; }

  /// Texels x samples that are missing at first, as far as can be told now, those of them that are done, and
  /// those that came from the cache.
  [[nodiscard]] double work() const { return expected_ > 0 ? expected_ : texels_ * wanted_ - earlier_; }
  [[nodiscard]] double done() const { return is_complete() ? work() : work_of(0, next_); }
  [[nodiscard]] double kept() const { return kept_; }
  /// By how much work() fell since the last call.
  [[nodiscard]] double take_less_work();

  /// Pictures in the layout's order, so far; and once it is complete.
  [[nodiscard]] const std::vector<BakedPicture>& pictures() const { return pictures_; }
  [[nodiscard]] std::vector<BakedPicture> take_pictures() { return std::move(pictures_); }

  /// Pictures so far, to go on from.
  [[nodiscard]] EarlierPictures so_far() const;

  /// Keys of its passes in the cache, of no use once their sum is kept.
  [[nodiscard]] std::vector<ResultKey> used_keys() const;

 private:
  [[nodiscard]] double work_of(std::size_t first, std::size_t last) const;
  [[nodiscard]] bool by_rounds() const { return noise_ > 0 || rules_.deadline; }
  void plan_passes(const HalfSamples& done);
  [[nodiscard]] HalfSamples shared_out(int samples) const;
  void plan_round();
  [[nodiscard]] int samples_of_round(double least_ratio) const;
  [[nodiscard]] int samples_in_time() const;
  [[nodiscard]] double expected_work(double greatest_ratio) const;
  [[nodiscard]] std::map<std::size_t, double> noise_by_target() const;
  [[nodiscard]] std::optional<std::vector<BakedPicture>> find_kept() const;
  void add(std::size_t pass, std::vector<BakedPicture> pictures);
  void take_baked();
  void answer(std::size_t number) const;

  const Plan& plan_;
  Batch batch_;
  BakeRequest request_;
  std::filesystem::path folder_;
  Rules rules_;
  const PassCache& cache_;
  ResultKey key_;
  int seed_ = 0, wanted_ = 0;
  double noise_ = 0, texels_ = 0, kept_ = 0, expected_ = 0, told_ = 0, earlier_ = 0, started_ = 0;
  std::vector<SamplePass> passes_;
  std::vector<std::vector<std::size_t>> left_out_;  // [passes] positions in the layout that are quiet enough
  std::size_t next_ = 0;                            // pass that is missing
  HalfSamples reached_{0, 0};                       // by all passes that are planned
  std::vector<BakedPicture> pictures_;
};

}  // namespace rnmbake
