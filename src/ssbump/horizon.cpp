#include "ssbump/horizon.h"

#include "ssbump/horizon_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

constexpr int least_period = 128;   // fewer steps hold too few slopes of lines that run into themselves
constexpr int block = 32;           // side of the squares that are transposed at once
constexpr int fixed_near_rows = 8;  // where the azimuths are told
constexpr std::array<AzimuthOptions, 5> doubling_sets{{
    {.azimuths = 32, .offset = 0.25, .near_rows = 8},
    {.azimuths = 32, .offset = 0.75, .near_rows = 8},
    {.azimuths = 64, .offset = 0, .near_rows = 16},
    {.azimuths = 128, .offset = 0.5, .near_rows = 32},
    {.azimuths = 256, .offset = 0.5, .near_rows = 32},
}};
constexpr double large_over_rmse = 10, most_large = 1e-4;  // errors that are large, and how many may be

GridAxis axis_of(int size, Beyond beyond, int least) {
  GridAxis axis{size, size, beyond};
  if (beyond == Beyond::mirror) axis.period = 2 * size;
  if (beyond != Beyond::none) axis.period *= (least + axis.period - 1) / axis.period;
  return axis;
}

/// Both sums together, channels interleaved.
SsbumpWeights together(const SweepTarget& by_rows, const SweepTarget& by_columns) {
  const int width = by_rows.last_line - by_rows.first_line,
            height = by_columns.last_line - by_columns.first_line;
  SsbumpWeights weights{FloatImage(width, height, SsbumpWeights::channels)};
  std::vector<float>& out = weights.image.data();
  constexpr auto channels = std::size_t{SsbumpWeights::channels};
  tbb::parallel_for(0, (height + block - 1) / block, [&](int row) {
    for (int left = 0; left < width; left += block) {
      for (int y = row * block; y < std::min(height, (row + 1) * block); ++y) {
        for (int x = left; x < std::min(width, left + block); ++x) {
          float* texel = &out[(std::size_t(y) * width + x) * channels];
          for (std::size_t c = 0; c < channels; ++c) {
            const std::size_t plane = std::min(c, std::size_t(by_rows.planes) - 1);
            const float sum =
                by_rows.sums[plane * by_rows.plane() + std::size_t(y) * by_rows.pitch() + x] +
                by_columns.sums[plane * by_columns.plane() + std::size_t(x) * by_columns.pitch() + y];
            texel[c] = std::clamp(sum, 0.0F, 1.0F);
          }
        }
      }
    }
  });
  return weights;
}

/// The rows that are wanted, as both grids see them.
class HorizonRows {
 public:
  HorizonRows(const HeightField& field, int first_row, int last_row, int most_near_rows, double power,
              std::function<bool()> stop)
      : power_(power), stop_(std::move(stop)) {
    const int width = field.width(), height = field.height();
    by_rows_ = make_grid(axis_of(height, field.y, least_period), axis_of(width, field.x, 1), most_near_rows);
    by_columns_ =
        make_grid(axis_of(width, field.x, least_period), axis_of(height, field.y, 1), most_near_rows);
    lay_heights(by_rows_, field.heights, false, most_near_rows, row_heights_);
    lay_heights(by_columns_, field.heights, true, most_near_rows, column_heights_);
    rows_.first_step = columns_.first_line = first_row;
    rows_.last_step = columns_.last_line = last_row;
    rows_.last_line = columns_.last_step = width;
  }

  /// By some azimuths alone. `progress`: the share of them.
  SsbumpWeights weights(const AzimuthOptions& options, const std::function<void(double)>& progress) {
    const AzimuthSets azimuths = make_azimuths(by_rows_, by_columns_, options);
    const double all = static_cast<double>(azimuths.by_rows.size() + azimuths.by_columns.size());
    double done = 0;
    const std::function<void()> say = [&] { progress(++done / all); };
    sweep(by_rows_, azimuths.by_rows, options.near_rows, rows_, say);
    sweep(by_columns_, azimuths.by_columns, options.near_rows, columns_, say);
    return together(rows_, columns_);
  }

 private:
  void sweep(const HorizonGrid& grid, const std::vector<Azimuth>& azimuths, int near_rows,
             SweepTarget& target, const std::function<void()>& say) {
    target.planes = power_ == 1 ? SsbumpWeights::channels - 1 : SsbumpWeights::channels;
    target.clear();
    const Reciprocals reciprocals(farthest_sight(grid));
    HorizonSines sines(target);
    SweepLines lines;
    for (std::size_t first = 0; first < azimuths.size(); first += HorizonSines::azimuths) {
      const std::size_t count = std::min(azimuths.size() - first, std::size_t{HorizonSines::azimuths});
      const std::span<const Azimuth> some(&azimuths[first], count);
      for (std::size_t i = 0; i < count; ++i) {
        if (stop_ && stop_()) return;
        const auto at = static_cast<int>(i);
        begin_lines(lines, grid, some[i]);
        sweep({grid,
               some[i],
               reciprocals,
               lines,
               target,
               {sines.of(target, at, 0), sines.of(target, at, 1)},
               near_rows});
        say();
      }
      tbb::parallel_for(0, target.steps(), [&](int step) { add_seen(target, sines, some, step); });
    }
  }

  void sweep(const SweepJob& job) {
    const int groups = (job.lines.count + lines_at_once() - 1) / lines_at_once();
    if (job.grid.steps.repeats()) {
      tbb::parallel_for(0, groups, [&](int group) { find_outstanding(job, group, scratch_.local()); });
      job.lines.highest_of_all = *std::ranges::max_element(job.lines.highest);
    }
    tbb::parallel_for(0, groups, [&](int group) { sweep_group(job, group, scratch_.local()); });
  }

  double power_;
  std::function<bool()> stop_;
  HorizonGrid by_rows_, by_columns_;
  LargeVector<float> row_heights_, column_heights_;
  SweepTarget rows_, columns_;
  tbb::enumerable_thread_specific<SweepScratch> scratch_;
};

/// How far two estimates are from each other: the RMS, and the share of values farther apart than `much`.
struct Difference {
  double rms = 0, share_of_much = 0;
};

/// The mean of two estimates that are as good as each other goes into the first.
Difference meet(SsbumpWeights& kept, const SsbumpWeights& more, double much) {
  std::vector<float>& values = kept.image.data();
  double squares = 0;
  std::size_t far = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double apart = std::abs(double{values[i]} - more.image.data()[i]);
    squares += apart * apart;
    if (apart > much) ++far;
    values[i] = (values[i] + more.image.data()[i]) / 2;
  }
  const auto count = static_cast<double>(values.size());
  return {std::sqrt(squares / count), static_cast<double>(far) / count};
}

/// Twice as many azimuths each time, those between the ones before, and more near rows, until the error is
/// small enough. The errors of estimates that are as good as each other and have nothing else in common make
/// them twice as far apart as their mean is from the truth.
SsbumpWeights refined(HorizonRows& rows, const GenerateOptions& options,
                      const std::function<void(double)>& progress) {
  SsbumpWeights weights;
  double done = 0;
  for (AzimuthOptions set : doubling_sets) {
    set.power = options.power;
    if (options.near_rows > 0) set.near_rows = options.near_rows;
    const bool is_first = weights.azimuths == 0;
    const double share = done < 0.5 ? 0.25 : (1 - done) / 2;
    SsbumpWeights more = rows.weights(set, [&](double part) { progress(done + share * part); });
    done += share;
    if (is_first) {
      weights = std::move(more);
      weights.azimuths = set.azimuths;
      continue;
    }
    const Difference apart = meet(weights, more, 2 * large_over_rmse * options.error);
    weights.azimuths += set.azimuths;
    weights.rmse = apart.rms / 2;
    if (weights.rmse <= options.error && apart.share_of_much <= most_large) break;
  }
  progress(1);
  return weights;
}

}  // namespace

SsbumpWeights horizon_rows(const HeightField& field, const GenerateOptions& options, int first_row,
                           int last_row, const std::function<void(double)>& progress,
                           const std::function<bool()>& stop) {
  const int most_near_rows = options.near_rows > 0   ? options.near_rows
                             : options.azimuths == 0 ? doubling_sets.back().near_rows
                                                     : fixed_near_rows;
  HorizonRows rows(field, first_row, last_row, most_near_rows, options.power, stop);
  const std::function<void(double)> say = progress ? progress : [](double) {};
  if (options.azimuths == 0) return refined(rows, options, say);
  SsbumpWeights weights = rows.weights({options.azimuths, 0.5, most_near_rows, options.power}, say);
  weights.azimuths = options.azimuths;
  return weights;
}

}  // namespace rnmbake
