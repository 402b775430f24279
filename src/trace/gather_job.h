// trace/gather_job.h - gathering for one target: its blocks of texels, and the number of samples of each.
#pragma once

#include "base/bytes.h"
#include "trace/block.h"
#include "trace/texel_samples.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

inline constexpr int wanted_batches = 16;
inline constexpr int pilot_samples = 16;  // to estimate the variance of a block

/// A block of texels with its plan and its statistics.
struct TexelBlock {
  std::size_t first = 0, count = 0;  // in TexelSamples::texels()
  int batch_samples = 1, batches = 0;
  std::unique_ptr<BatchStatistics> statistics;
  std::int64_t rays = 0;
  std::vector<std::int64_t> back_faces;
  std::int64_t lit = 0, shared = 0;  // primary rays, where somebody else follows them (BlockGatherer)

  [[nodiscard]] std::int64_t samples() const { return std::int64_t(statistics->batches()) * batch_samples; }
  /// That the plan asks for beyond those that are there.
  [[nodiscard]] double missing_paths() const {
    const int missing = batches - (statistics ? statistics->batches() : 0);
    return double(std::max(0, missing)) * batch_samples * double(count);
  }
};

/// Some blocks in a row, and what a round adds to them.
struct BlockRange {
  std::size_t first = 0, count = 0;
  double paths = 0;
};

class GatherJob {
 public:
  GatherJob(const TraceScene& scene, std::size_t index, const GatherTarget& target,
            const GatherOptions& options)
      : scene_(scene),
        index_(index),
        target_(target),
        options_(options),
        texel_samples_(*target.surface, target.width, target.height, options.footprint, options.past_edge) {
    if (options.faults.any()) own_.emplace(scene, target);
    for (std::size_t first = 0; first < texels(); first += BlockGatherer::most_points) {
      blocks_.push_back({first, std::min(BlockGatherer::most_points, texels() - first), 1, 0, {}, 0, {}});
    }
  }

  [[nodiscard]] std::size_t index() const { return index_; }
  [[nodiscard]] const GatherTarget& target() const { return target_; }
  [[nodiscard]] std::size_t texels() const { return texel_samples_.size(); }
  std::vector<TexelBlock>& blocks() { return blocks_; }
  [[nodiscard]] const std::vector<TexelBlock>& blocks() const { return blocks_; }

  /// Gathers the batches that a block's plan asks for. `stage`: makes the pilot's samples independent of the
  /// rest. `go_on` is called after each batch with its share of the work, and ends the work by false.
  /// `incident`: see BlockGatherer.
  void work(TexelBlock& block, std::uint64_t stage, const std::function<bool(double)>& go_on,
            const Incident* incident = nullptr) const {
    BlockGatherer gatherer(scene_, texel_samples_, options_, own_ ? &*own_ : nullptr, incident);
    if (!block.statistics)
      block.statistics = std::make_unique<BatchStatistics>(block.count, gatherer.values());
    const std::uint64_t seed = hash_of(hash_of(hash_of(options_.seed, target_.stream), stage), block.first);
    const double share = 1.0 / std::max(1, block.batches - block.statistics->batches());
    while (block.statistics->batches() < block.batches) {
      const auto number = static_cast<std::uint64_t>(block.statistics->batches());
      gatherer.batch(block.first, block.count, block.batch_samples, hash_of(seed, number), *block.statistics);
      if (!go_on(share)) return;
    }
    block.rays += gatherer.rays();
    block.lit += gatherer.lit();
    block.shared += gatherer.shared();
    block.back_faces.resize(block.count);
    for (std::size_t i = 0; i < block.count; ++i) block.back_faces[i] += gatherer.back_faces()[i];
  }

  void plan(TexelBlock& block, std::int64_t samples) const {
    const std::int64_t wanted = std::clamp<std::int64_t>(samples, 1, options_.samples);
    block.batch_samples = static_cast<int>(std::max<std::int64_t>(1, wanted / wanted_batches));
    block.batches = static_cast<int>((wanted + block.batch_samples - 1) / block.batch_samples);
  }

  /// Allocates samples to blocks by the pilot's variances, so that the fewest give the wanted error (Neyman
  /// 1934).
  void plan_for_error() {
    const std::vector<double> means = direction_means();
    std::vector<double>
        noise;  // standard deviation of a sample over its direction's mean: the worst direction's
    double sum = 0;
    for (const TexelBlock& block : blocks_) {
      double square = 0;
      for (std::size_t k = 0; k < means.size(); ++k)
        square = std::max(square, relative_square(block, k, means[k]));
      noise.push_back(std::sqrt(square / double(block.count) * double(block.samples())));
      sum += noise.back() * double(block.count);
    }
    const double wanted = sum / (covered() * options_.error * options_.error);
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      blocks_[b].statistics.reset();
      plan(blocks_[b], std::max<std::int64_t>(pilot_samples, std::llround(std::ceil(noise[b] * wanted))));
    }
  }

  /// Plans more batches; false where the wanted error or the largest number of samples is reached.
  bool plan_more() {
    const double ratio = relative_error() / options_.error;
    if (!(ratio > 1)) return false;
    bool more = false;
    for (TexelBlock& block : blocks_) {
      const auto most = static_cast<int>(options_.samples / block.batch_samples);
      const int batches = std::min(most, static_cast<int>(std::ceil(block.batches * ratio * ratio * 1.05)));
      more |= batches > block.batches;
      block.batches = std::max(block.batches, batches);
    }
    return more;
  }

  /// Blocks of which the plan asks more, and those between them, cut into ranges of so many paths.
  [[nodiscard]] std::vector<BlockRange> missing(double paths) const {
    std::vector<BlockRange> ranges;
    BlockRange range;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      range.paths += blocks_[b].missing_paths();
      ++range.count;
      if (range.paths < paths && b + 1 < blocks_.size()) continue;
      if (range.paths > 0) ranges.push_back(range);
      range = {b + 1, 0, 0};
    }
    return ranges;
  }

  /// What was gathered for some blocks, as bytes.
  [[nodiscard]] std::string state(std::size_t first, std::size_t count) const {
    std::string bytes;
    for (std::size_t b = first; b < first + count; ++b) {
      const TexelBlock& block = blocks_[b];
      put(bytes, std::int32_t{block.batch_samples});
      put(bytes, std::int32_t{block.batches});
      put(bytes, block.rays);
      bytes += bytes_of(block.back_faces);
      block.statistics->put_into(bytes);
    }
    return bytes;
  }

  /// ... and back; false, and nothing is changed, where they are no such bytes.
  [[nodiscard]] bool restore(std::size_t first, std::size_t count, std::string_view bytes) {
    ByteReader in(bytes);
    std::vector<TexelBlock> found;
    const std::size_t values =
        options_.directions.size() + std::size_t(options_.sh_order) * std::size_t(options_.sh_order);
    for (std::size_t b = first; b < first + count; ++b) {
      TexelBlock block{blocks_[b].first, blocks_[b].count, 1, 0, {}, 0, {}};
      std::int32_t batch_samples = 0, batches = 0;
      block.back_faces.resize(block.count);
      block.statistics = std::make_unique<BatchStatistics>(block.count, values);
      if (!in.take(batch_samples) || !in.take(batches) || !in.take(block.rays) ||
          !in.take(block.back_faces) || !block.statistics->take_from(in))
        return false;
      block.batch_samples = batch_samples;
      block.batches = batches;
      found.push_back(std::move(block));
    }
    if (in.left() > 0) return false;
    std::move(found.begin(), found.end(), blocks_.begin() + std::ptrdiff_t(first));
    return true;
  }

  Gathered result() const { return result(blocks_); }

  /// Of blocks like this target's.
  [[nodiscard]] Gathered result(const std::vector<TexelBlock>& blocks) const {
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
    for (const TexelBlock& block : blocks) write(block, out);
    for (GatheredDirection& direction : out.directions) {
      for (double& error : direction.mean_error) error = std::sqrt(error);
    }
    return out;
  }

 private:
  void write(const TexelBlock& block, Gathered& out) const {
    const auto put = [](FloatImage& image, const TexelSample& texel, const Vec3& value) {
      std::copy_n(&value.x, 3, image.texel(texel.x, texel.y).begin());
    };
    out.paths += block.samples() * std::int64_t(block.count);
    out.rays += block.rays;
    for (std::size_t i = 0; i < block.count; ++i) {
      const TexelSample& texel = texel_samples_.texels()[block.first + i];
      out.coverage.texel(texel.x, texel.y)[0] = 1;
      out.validity.texel(texel.x, texel.y)[0] =
          1 - static_cast<float>(double(block.back_faces[i]) / double(block.samples()));
      for (std::size_t k = 0; k < out.directions.size(); ++k) {
        const Vec3 square = block.statistics->squared_error(i, k);
        put(out.directions[k].radiance, texel, block.statistics->mean(i, k));
        put(out.directions[k].standard_error, texel,
            {std::sqrt(square.x), std::sqrt(square.y), std::sqrt(square.z)});
      }
      for (std::size_t c = 0; c < out.sh.size(); ++c) {
        put(out.sh[c], texel, block.statistics->mean(i, out.directions.size() + c));
      }
    }
    const double share = double(block.count) / covered();
    for (std::size_t k = 0; k < out.directions.size(); ++k) {
      const Vec3 mean = block.statistics->whole_mean(k), square = block.statistics->whole_squared_error(k);
      for (int c = 0; c < 3; ++c) {
        out.directions[k].mean[c] += share * mean[c];
        out.directions[k].mean_error[c] += share * share * square[c];  // squared until all blocks are in
      }
    }
  }

  [[nodiscard]] double covered() const { return std::max(1.0, double(texels())); }

  [[nodiscard]] std::vector<double> direction_means() const {
    std::vector<double> means(options_.directions.size());
    for (const TexelBlock& block : blocks_) {
      for (std::size_t k = 0; k < means.size(); ++k) {
        const Vec3 mean = block.statistics->whole_mean(k);
        means[k] += double(mean.x + mean.y + mean.z) / 3 * double(block.count) / covered();
      }
    }
    return means;
  }

  /// Sum over texels of the squared standard error (mean over colours), over the squared mean of the
  /// direction.
  [[nodiscard]] static double relative_square(const TexelBlock& block, std::size_t k, double mean) {
    double sum = 0;
    for (std::size_t i = 0; i < block.count; ++i) {
      const Vec3 square = block.statistics->squared_error(i, k);
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
      for (const TexelBlock& block : blocks_) sum += relative_square(block, k, means[k]);
      worst = std::max(worst, sum / covered());
    }
    return std::sqrt(worst);
  }

  const TraceScene& scene_;
  std::size_t index_;
  const GatherTarget& target_;
  const GatherOptions& options_;
  TexelSamples texel_samples_;
  std::optional<OwnSurface> own_;
  std::vector<TexelBlock> blocks_;
};

}  // namespace rnmbake
