// ssbump/horizon/horizon_sweep.h - sweeps some lines of an azimuth over the map, forth and back.
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

/// Lines of one azimuth, told by where they start at step 0. Where steps repeat, what of each line may stand
/// out of it from anywhere outside of its one period.
struct SweepLines {
  int first = 0, count = 0;
  std::vector<std::vector<LinePoint>> outstanding;  // steps rise
  std::vector<float> highest, highest_but_start,
      highest_but_end;  // without what the next line's block takes in
  float highest_of_all = 0;

  [[nodiscard]] bool valid(int line) const { return line >= first && line < first + count; }
};
/// Into `lines`, whose memory is used again.
void begin_lines(SweepLines& lines, const HorizonGrid& grid, const Azimuth& azimuth);

struct SweepJob {
  const HorizonGrid& grid;
  const Azimuth& azimuth;
  const Reciprocals& reciprocals;
  SweepLines& lines;
  const SweepTarget& target;
  std::array<std::uint16_t*, 2> sines;  // out: of the horizons forth and back, SweepTarget's planes
  int near_rows = 8;
};

/// How far apart places may be that see each other.
[[nodiscard]] int farthest_sight(const HorizonGrid& grid);

/// What a thread keeps between groups of lines.
struct SweepScratch {
  std::vector<float> heights;      // of lines_at_once() lines, one after the other
  std::vector<LineHull> hulls;     // of each line
  std::vector<LinePoint> beyond;   // of one line
  std::vector<LinePart> parts;     // of it
  std::vector<float> far_heights;  // behind a border, of lines_at_once() lines
};

/// Lines that this processor's instructions sweep at once: they are one group.
[[nodiscard]] int lines_at_once();
/// The instructions in use, and all that could be, best first, in Highway's names.
[[nodiscard]] std::vector<std::string> sweep_instructions();
/// For measurements: use these of sweep_instructions(). Not while a sweep runs.
void use_sweep_instructions(const std::string& name);

/// Fills lines.outstanding and lines.highest of a group; needed before any sweep where the steps repeat.
void find_outstanding(const SweepJob& job, int group, SweepScratch& scratch);
/// Writes the sines of the horizons. Groups of one azimuth touch different texels, and all of them together
/// every texel of the target.
void sweep_group(const SweepJob& job, int group, SweepScratch& scratch);

}  // namespace rnmbake
