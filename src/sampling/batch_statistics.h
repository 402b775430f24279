// sampling/batch_statistics.h - means and standard errors from batches of samples.
#pragma once

#include "base/bytes.h"
#include "base/math.h"
#include "base/numeric/running_moments.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rnmbake {

/// Estimates `values` colours for each of `texels` texels. Samples within a batch may be correlated (they are
/// stratified), batches are independent: the standard error comes from the variance of the batches' means.
/// All batches have the same number of samples.
class BatchStatistics {
 public:
  BatchStatistics(std::size_t texels, std::size_t values)
      : texels_(texels),
        values_(values),
        batch_(texels * values, Vec3(0)),
        state_(texels * values),
        whole_(values) {}

  /// Sums of the current batch, to add samples to.
  [[nodiscard]] Vec3* texel(std::size_t index) { return &batch_[index * values_]; }
  void end_batch(int samples);

  [[nodiscard]] int batches() const { return batches_; }
  [[nodiscard]] Vec3 mean(std::size_t texel, std::size_t value) const {
    return state_[texel * values_ + value].mean;
  }
  /// Squared standard error of a texel's mean; 0 with fewer than two batches.
  [[nodiscard]] Vec3 squared_error(std::size_t texel, std::size_t value) const {
    return squared_error(state_[texel * values_ + value]);
  }
  /// Of the mean over all texels, whose errors are correlated.
  [[nodiscard]] Vec3 whole_mean(std::size_t value) const { return whole_[value].mean; }
  [[nodiscard]] Vec3 whole_squared_error(std::size_t value) const { return squared_error(whole_[value]); }

  /// All batches that ended, as bytes.
  void put_into(std::string& bytes) const {
    put(bytes, std::int32_t{batches_});
    bytes += bytes_of(state_);
    bytes += bytes_of(whole_);
  }
  /// ... and back, into statistics of as many texels and values.
  [[nodiscard]] bool take_from(ByteReader& in) {
    std::int32_t batches = 0;
    if (!in.take(batches) || !in.take(state_) || !in.take(whole_)) return false;
    batches_ = batches;
    return batches >= 0;
  }

 private:
  using Moments = RunningMoments<Vec3>;
  [[nodiscard]] Vec3 squared_error(const Moments& moments) const {
    if (batches_ < 2) return Vec3(0);
    return moments.squares / (static_cast<float>(batches_) * static_cast<float>(batches_ - 1));
  }

  std::size_t texels_, values_;
  int batches_ = 0;
  std::vector<Vec3> batch_;     // [texels][values]
  std::vector<Moments> state_;  // [texels][values]
  std::vector<Moments> whole_;  // [values]
};

inline void BatchStatistics::end_batch(int samples) {
  ++batches_;
  const float scale = 1 / static_cast<float>(samples), count = static_cast<float>(batches_);
  for (std::size_t v = 0; v < values_; ++v) {
    Vec3 sum(0);
    for (std::size_t t = 0; t < texels_; ++t) {
      Vec3& cell = batch_[t * values_ + v];
      state_[t * values_ + v].add(cell * scale, count);
      sum += cell;
      cell = Vec3(0);
    }
    whole_[v].add(sum * (scale / static_cast<float>(texels_)), count);
  }
}

}  // namespace rnmbake
