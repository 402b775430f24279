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

constexpr int least_period = 128;  // fewer steps hold too few slopes of lines that run into themselves
constexpr int block = 32;          // side of the squares that are transposed at once
constexpr int horizon_near_rows = 8, horizon_near_rows_of_more = 16;  // the latter past 64 azimuths
constexpr double largest_over_rmse = 10;                              // errors that are asked for

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
  std::vector<float> row_heights_, column_heights_;
  SweepTarget rows_, columns_;
  tbb::enumerable_thread_specific<SweepScratch> scratch_;
};

/// How far two estimates are from each other.
struct Difference {
  double rms = 0, largest = 0;
};

/// The mean of two estimates that are as good as each other goes into the first.
Difference meet(SsbumpWeights& kept, const SsbumpWeights& more) {
  Difference difference;
  std::vector<float>& values = kept.image.data();
  double squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double apart = std::abs(double{values[i]} - more.image.data()[i]);
    squares += apart * apart;
    difference.largest = std::max(difference.largest, apart);
    values[i] = (values[i] + more.image.data()[i]) / 2;
  }
  difference.rms = std::sqrt(squares / static_cast<double>(values.size()));
  return difference;
}

/// Twice as many azimuths, those between the ones before, until the error is small enough. The errors of
/// estimates that are as good as each other and have nothing else in common make them twice as far apart as
/// their mean is from the truth.
SsbumpWeights refined(HorizonRows& rows, const GenerateOptions& options,
                      const std::function<void(double)>& progress) {
  constexpr int first_azimuths = 32, few_azimuths = 64, most_azimuths = 512;
  constexpr std::array<double, 4> offsets{0.25, 0.75, 0, 0.5};  // of 32, 32, 64, 128 and all after
  double done = 0;
  const auto set = [&](int azimuths, std::size_t number) {
    const double share = number < 2 ? 0.25 : (1 - done) / 2;
    const int near_rows = options.near_rows > 0 ? options.near_rows
                          : number < 2          ? horizon_near_rows
                                                : horizon_near_rows_of_more;
    SsbumpWeights weights =
        rows.weights({azimuths, offsets[std::min(number, offsets.size() - 1)], near_rows, options.power},
                     [&](double part) { progress(done + share * part); });
    done += share;
    return weights;
  };
  SsbumpWeights weights = set(first_azimuths, 0);
  weights.azimuths = first_azimuths;
  for (std::size_t number = 1;; ++number) {
    const Difference apart = meet(weights, set(weights.azimuths, number));
    weights.azimuths *= 2;
    weights.rmse = apart.rms / 2;
    const bool good = weights.rmse <= options.error && apart.largest / 2 <= largest_over_rmse * options.error;
    if (weights.azimuths >= few_azimuths && (good || weights.azimuths >= most_azimuths)) break;
  }
  progress(1);
  return weights;
}

}  // namespace

SsbumpWeights horizon_rows(const HeightField& field, const GenerateOptions& options, int first_row,
                           int last_row, const std::function<void(double)>& progress,
                           const std::function<bool()>& stop) {
  const int most_near_rows = options.near_rows > 0   ? options.near_rows
                             : options.azimuths == 0 ? horizon_near_rows_of_more
                                                     : horizon_near_rows;
  HorizonRows rows(field, first_row, last_row, most_near_rows, options.power, stop);
  const std::function<void(double)> say = progress ? progress : [](double) {};
  if (options.azimuths == 0) return refined(rows, options, say);
  SsbumpWeights weights = rows.weights({options.azimuths, 0.5, most_near_rows, options.power}, say);
  weights.azimuths = options.azimuths;
  return weights;
}

}  // namespace rnmbake
