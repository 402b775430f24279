// ssbump/horizon/sweep_lines.h - the lines of a sweep, and a thread's memory.
#pragma once

#include "ssbump/horizon/horizon_azimuth.h"
#include "ssbump/horizon/horizon_grid.h"
#include "ssbump/horizon/horizon_sums.h"
#include "ssbump/horizon/line_hull.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rnmbake {

/// Lines of one azimuth, indexed by their offset at step 0. Where steps repeat: points of each line's one
/// period that can be the horizon of texels outside of that period.
struct SweepLines {
  int first = 0, count = 0;
  std::vector<std::vector<LinePoint>> outstanding;  // steps rise
  std::vector<float> highest, highest_but_start,
      highest_but_end;  // without the points of the first block in the next period
  float highest_of_all = 0;

  [[nodiscard]] bool valid(int line) const { return line >= first && line < first + count; }
};
struct SweepJob {
  const HorizonGrid& grid;
  const Azimuth& azimuth;
  const Reciprocals& reciprocals;
  SweepLines& lines;
  const SweepTarget& target;
  std::array<std::uint16_t*, 2> sines;  // out: of the horizons forth and back, SweepTarget's planes
  int near_rows = 8;
};

/// Memory of a thread, kept between groups of lines.
struct SweepScratch {
  std::vector<float> heights;      // of lines_at_once() lines, one after the other
  std::vector<LineHull> hulls;     // of each line
  std::vector<LinePoint> beyond;   // of one line
  std::vector<LinePart> parts;     // of it
  std::vector<float> far_heights;  // behind a border, of lines_at_once() lines
};

}  // namespace rnmbake
