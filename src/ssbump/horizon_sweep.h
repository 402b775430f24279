// ssbump/horizon_sweep.h - sweeps some lines of an azimuth over the map, forth and back.
#pragma once

#include "ssbump/horizon_azimuth.h"
#include "ssbump/horizon_grid.h"
#include "ssbump/hull.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rnmbake {

/// The texels that are wanted, and the sums that they add up to: one plane for each channel, lines side by
/// side as in the grid.
struct SweepTarget {
  int first_step = 0, last_step = 0;  // the last is the first that is not wanted
  int first_line = 0, last_line = 0;
  int planes = 4;  // 4: power 1, straight up and ambient are the same
  std::vector<float> sums;

  [[nodiscard]] std::size_t pitch() const {
    return row_pitch(static_cast<std::size_t>(last_line - first_line));
  }
  [[nodiscard]] std::size_t plane() const {
    return pitch() * static_cast<std::size_t>(last_step - first_step);
  }
  void clear() { sums.assign(plane() * static_cast<std::size_t>(planes), 0.0F); }
};

/// Lines of one azimuth, told by where they start at step 0, and the highest point of each over one period.
struct SweepLines {
  int first = 0, count = 0;
  std::vector<float> highest;
  std::vector<int> first_at, last_at;  // at which steps
  float highest_of_all = 0;

  /// Groups of lines_at_once().
  [[nodiscard]] int groups() const;
  [[nodiscard]] bool valid(int line) const { return line >= first && line < first + count; }
};
[[nodiscard]] SweepLines lines_of(const HorizonGrid& grid, const Azimuth& azimuth);

struct SweepJob {
  const HorizonGrid& grid;
  const Azimuth& azimuth;
  SweepLines& lines;
  SweepTarget& target;
  int near_rows = 8;
  bool linear = true;  // power 1
};

/// What a thread keeps between groups.
struct SweepScratch {
  HullStorage hull;
  std::vector<float> slopes;  // of each step, lanes side by side
};

/// Instructions that a sweep is compiled for; `best` is what this processor has.
enum class SweepIsa : std::uint8_t { baseline, avx2, avx512 };
[[nodiscard]] SweepIsa best_isa();
/// For measurements: use less than the best.
void limit_isa(SweepIsa isa);
[[nodiscard]] int lines_at_once();

/// Fills lines.highest and its places of a group; needed before any sweep where the steps repeat.
void find_highest(const SweepJob& job, int group);
/// Adds to the target. Groups of one azimuth touch different texels.
void sweep_group(const SweepJob& job, int group, SweepScratch& scratch);

}  // namespace rnmbake
