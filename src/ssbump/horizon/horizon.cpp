#include "ssbump/horizon/horizon.h"

#include "ssbump/horizon/horizon_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

constexpr int least_period = 128;   // fewer steps hold too few slopes of lines that run into themselves
constexpr std::size_t block = 32;   // side of the squares that are transposed at once
constexpr int fixed_near_rows = 8;  // where --azimuths is given
// Offset of the first azimuth, as share of their distance. On planes all error is that of the sum over
// azimuths, which has kinks where the plane's slope leaves the horizon. With kinks along rows, columns and
// diagonals a quarter is by far the best offset (Euler and Maclaurin), and two halves of the sum err to
// opposite sides.
constexpr double best_offset = 0.25;
constexpr std::array<AzimuthOptions, 5> doubling_sets{{
    {.azimuths = 32, .offset = best_offset / 2, .near_rows = 8},
    {.azimuths = 32, .offset = best_offset / 2 + 0.5, .near_rows = 8},
    {.azimuths = 64, .offset = best_offset + 0.5, .near_rows = 16},
    {.azimuths = 128, .offset = 0, .near_rows = 32},
    {.azimuths = 256, .offset = 0.5, .near_rows = 32},
}};
constexpr double large_over_rmse = 10, most_large = 1e-4;  // errors that are large, and how many may be

GridAxis axis_of(int size, WrapMode beyond, int least) {
  GridAxis axis{size, size, beyond};
  if (beyond == WrapMode::mirror) axis.period = 2 * size;
  if (beyond != WrapMode::none) axis.period *= (least + axis.period - 1) / axis.period;
  return axis;
}

/// A block's worth of rows at once.
template <typename Work>
void for_blocks(std::size_t rows, const Work& work) {
  tbb::parallel_for(std::size_t{0}, (rows + block - 1) / block,
                    [&](std::size_t part) { work(part * block, std::min(rows, (part + 1) * block)); });
}

/// Adds sums over the other grid, whose steps are lines here.
void add_transposed(const SweepTarget& other, SweepTarget& target) {
  const auto rows = static_cast<std::size_t>(target.steps()),
             columns = static_cast<std::size_t>(other.steps());
  const std::size_t pitch = target.pitch(), other_pitch = other.pitch();
  for_blocks(rows, [&](std::size_t top, std::size_t bottom) {
    for (std::size_t plane = 0; plane < static_cast<std::size_t>(target.planes); ++plane) {
      float* const to = &target.sums[plane * target.plane()];
      const float* const from = &other.sums[plane * other.plane()];
      for (std::size_t left = 0; left < columns; left += block) {
        for (std::size_t y = top; y < bottom; ++y) {
          for (std::size_t x = left; x < std::min(columns, left + block); ++x)
            to[y * pitch + x] += from[x * other_pitch + y];
        }
      }
    }
  });
}

/// Weights with the target's planes as channels.
SsbumpWeights interleaved(const SweepTarget& target) {
  constexpr auto channels = std::size_t{SsbumpWeights::channels};
  const int width = target.last_line - target.first_line;
  SsbumpWeights weights{FloatImage(width, target.steps(), SsbumpWeights::channels)};
  for_blocks(static_cast<std::size_t>(target.steps()), [&](std::size_t top, std::size_t bottom) {
    for (std::size_t y = top; y < bottom; ++y) {
      float* texel = weights.image.data().data() + y * static_cast<std::size_t>(width) * channels;
      const float* const row = &target.sums[y * target.pitch()];
      const std::size_t plane = target.plane(), last = (static_cast<std::size_t>(target.planes) - 1) * plane;
      for (int x = 0; x < width; ++x, texel += channels) {
        for (std::size_t c = 0; c < channels; ++c)
          texel[c] = std::clamp(row[std::min(c * plane, last) + static_cast<std::size_t>(x)], 0.0F, 1.0F);
      }
    }
  });
  return weights;
}

/// Sums over azimuths for the rows first_row .. last_row - 1.
class HorizonRows {
 public:
  HorizonRows(const HeightField& field, int first_row, int last_row, int most_near_rows, double power,
              std::function<bool()> stop)
      : field_(field),
        first_row_(first_row),
        last_row_(last_row),
        most_near_rows_(most_near_rows),
        power_(power),
        stop_(std::move(stop)),
        by_rows_(grid_of(field.height(), field.y, field.width(), field.x)),
        by_columns_(grid_of(field.width(), field.x, field.height(), field.y)) {}

  /// Sums over these azimuths alone, valid until the next call. `progress` receives the share done.
  SweepTarget& sums(const AzimuthOptions& options, const std::function<void(double)>& progress) {
    const AzimuthSets azimuths = make_azimuths(by_rows_, by_columns_, options);
    const double all = static_cast<double>(azimuths.by_rows.size() + azimuths.by_columns.size());
    double done = 0;
    const std::function<void()> say = [&] { progress(++done / all); };
    rows_.first_step = columns_.first_line = first_row_;
    rows_.last_step = columns_.last_line = last_row_;
    rows_.last_line = columns_.last_step = field_.width();
    sweep(by_rows_, false, azimuths.by_rows, options.near_rows, rows_, say);
    sweep(by_columns_, true, azimuths.by_columns, options.near_rows, columns_, say);
    add_transposed(columns_, rows_);
    return rows_;
  }

 private:
  [[nodiscard]] HorizonGrid grid_of(int steps, WrapMode over, int lines, WrapMode aside) const {
    return make_grid(axis_of(steps, over, least_period), axis_of(lines, aside, 1), most_near_rows_);
  }

  void sweep(HorizonGrid& grid, bool by_columns, const std::vector<Azimuth>& azimuths, int near_rows,
             SweepTarget& target, const std::function<void()>& say) {
    lay_heights(grid, field_.heights, by_columns, most_near_rows_, heights_);
    target.planes = power_ == 1 ? SsbumpWeights::channels - 1 : SsbumpWeights::channels;
    target.make_room();
    sines_.make_room(target);
    const Reciprocals& reciprocals = reciprocals_to(farthest_sight(grid));
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
               {sines_.of(target, at, 0), sines_.of(target, at, 1)},
               near_rows});
        say();
      }
      tbb::parallel_for(0, target.steps(),
                        [&](int step) { add_seen(target, sines_, some, step, first == 0); });
    }
  }

  const Reciprocals& reciprocals_to(int farthest) {
    if (!reciprocals_ || reciprocals_->farthest() != farthest) reciprocals_.emplace(farthest);
    return *reciprocals_;
  }

  void sweep(const SweepJob& job) {
    const int groups = (job.lines.count + lines_at_once() - 1) / lines_at_once();
    if (job.grid.steps.repeats()) {
      tbb::parallel_for(0, groups, [&](int group) { find_outstanding(job, group, scratch_.local()); });
      job.lines.highest_of_all = *std::ranges::max_element(job.lines.highest);
    }
    tbb::parallel_for(0, groups, [&](int group) { sweep_group(job, group, scratch_.local()); });
  }

  const HeightField& field_;
  int first_row_, last_row_, most_near_rows_;
  double power_;
  std::function<bool()> stop_;
  HorizonGrid by_rows_, by_columns_;
  LargeVector<float> heights_;  // of the grid in use
  SweepTarget rows_, columns_;
  HorizonSines sines_;
  std::optional<Reciprocals> reciprocals_;
  tbb::enumerable_thread_specific<SweepScratch> scratch_;
};

/// Difference of two estimates: RMS, and share of values that differ by more than `much`.
struct Difference {
  double rms = 0, share_of_much = 0;
};

/// Replaces the first estimate by the mean of both, which are equally exact. Returns their difference.
Difference meet(SweepTarget& kept, const SweepTarget& more, double much) {
  struct Row {
    double squares = 0;
    std::size_t far = 0;
  };
  const auto steps = static_cast<std::size_t>(kept.steps()), planes = static_cast<std::size_t>(kept.planes);
  const auto lines = static_cast<std::size_t>(kept.last_line - kept.first_line);
  std::vector<Row> rows(steps);
  for_blocks(steps, [&](std::size_t top, std::size_t bottom) {
    for (std::size_t step = top; step < bottom; ++step) {
      for (std::size_t plane = 0; plane < planes; ++plane) {
        const std::size_t first = plane * kept.plane() + step * kept.pitch();
        for (std::size_t i = first; i < first + lines; ++i) {
          const double apart = double{kept.sums[i]} - more.sums[i];
          rows[step].squares += apart * apart;
          if (std::abs(apart) > much) ++rows[step].far;
          kept.sums[i] = (kept.sums[i] + more.sums[i]) / 2;
        }
      }
    }
  });
  Row all;
  for (const Row& row : rows) all = {all.squares + row.squares, all.far + row.far};
  const auto count = static_cast<double>(steps * lines * planes);
  return {std::sqrt(all.squares / count), static_cast<double>(all.far) / count};
}

/// Twice as many azimuths each time, those between the ones before, and more near rows, until the error is
/// small enough. The errors of estimates that are as good as each other and have nothing else in common make
/// them twice as far apart as their mean is from the truth.
SsbumpWeights refined(HorizonRows& rows, const GenerateOptions& options,
                      const std::function<void(double)>& progress) {
  SweepTarget kept;
  int azimuths = 0;
  double done = 0, rmse = 0;
  for (AzimuthOptions set : doubling_sets) {
    set.power = options.power;
    if (options.near_rows > 0) set.near_rows = options.near_rows;
    const double share = done < 0.5 ? 0.25 : (1 - done) / 2;
    SweepTarget& more = rows.sums(set, [&](double part) { progress(done + share * part); });
    done += share;
    azimuths += set.azimuths;
    if (azimuths == set.azimuths) {
      kept = std::move(more);
      continue;
    }
    const Difference apart = meet(kept, more, 2 * large_over_rmse * options.error);
    rmse = apart.rms / 2;
    if (rmse <= options.error && apart.share_of_much <= most_large) break;
  }
  progress(1);
  SsbumpWeights weights = interleaved(kept);
  weights.azimuths = azimuths;
  weights.rmse = rmse;
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
  SsbumpWeights weights =
      interleaved(rows.sums({options.azimuths, best_offset, most_near_rows, options.power}, say));
  weights.azimuths = options.azimuths;
  return weights;
}

}  // namespace rnmbake
