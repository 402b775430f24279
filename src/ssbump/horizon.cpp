#include "ssbump/horizon.h"

#include "ssbump/horizon_sweep.h"

#include <algorithm>
#include <span>
#include <vector>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rnmbake {
namespace {

constexpr int least_period = 128;  // fewer steps hold too few slopes of lines that run into themselves
constexpr int block = 32;          // side of the squares that are transposed at once

GridAxis axis_of(int size, Beyond beyond, int least) {
  GridAxis axis{size, size, beyond};
  if (beyond == Beyond::mirror) axis.period = 2 * size;
  if (beyond != Beyond::none) axis.period *= (least + axis.period - 1) / axis.period;
  return axis;
}

/// A sweep over all azimuths of one grid.
class Sweeps {
 public:
  Sweeps(const GenerateOptions& options, const std::function<void()>& say, const std::function<bool()>& stop)
      : options_(options), say_(say), stop_(stop) {}

  void run(const HorizonGrid& grid, const std::vector<Azimuth>& azimuths, SweepTarget& target) {
    target.planes = options_.power == 1 ? SsbumpWeights::channels - 1 : SsbumpWeights::channels;
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
               options_.near_rows});
        say_();
      }
      tbb::parallel_for(0, target.steps(), [&](int step) { add_seen(target, sines, some, step); });
    }
  }

 private:
  void sweep(const SweepJob& job) {
    const int groups = (job.lines.count + lines_at_once() - 1) / lines_at_once();
    if (job.grid.steps.repeats()) {
      tbb::parallel_for(0, groups, [&](int group) { find_outstanding(job, group, scratch_.local()); });
      job.lines.highest_of_all = *std::ranges::max_element(job.lines.highest);
    }
    tbb::parallel_for(0, groups, [&](int group) { sweep_group(job, group, scratch_.local()); });
  }

  const GenerateOptions& options_;
  const std::function<void()>& say_;
  const std::function<bool()>& stop_;
  tbb::enumerable_thread_specific<SweepScratch> scratch_;
};

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

}  // namespace

SsbumpWeights horizon_rows(const HeightField& field, const GenerateOptions& options, int first_row,
                           int last_row, const std::function<void(double)>& progress,
                           const std::function<bool()>& stop) {
  const int width = field.width(), height = field.height();
  HorizonGrid by_rows =
      make_grid(axis_of(height, field.y, least_period), axis_of(width, field.x, 1), options.near_rows);
  HorizonGrid by_columns =
      make_grid(axis_of(width, field.x, least_period), axis_of(height, field.y, 1), options.near_rows);

  SweepTarget rows, columns;
  rows.first_step = columns.first_line = first_row;
  rows.last_step = columns.last_line = last_row;
  rows.last_line = columns.last_step = width;
  std::vector<float> memory;
  lay_heights(by_rows, field.heights, false, options.near_rows, memory);
  const AzimuthSets azimuths =
      make_azimuths(by_rows, by_columns, {options.azimuths, options.near_rows, options.power});

  const double all = static_cast<double>(azimuths.by_rows.size() + azimuths.by_columns.size());
  double done = 0;
  const std::function<void()> say = [&] {
    if (progress) progress(++done / all);
  };
  Sweeps sweeps(options, say, stop);
  sweeps.run(by_rows, azimuths.by_rows, rows);
  lay_heights(by_columns, field.heights, true, options.near_rows, memory);
  sweeps.run(by_columns, azimuths.by_columns, columns);
  return together(rows, columns);
}

}  // namespace rnmbake
