// ssbump/horizon/horizon_sweep.h - sweeps some lines of an azimuth over the map, forth and back.
#pragma once

#include "ssbump/horizon/sweep_lines.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rnmbake {

/// Resets `lines` to an azimuth; keeps its memory.
void begin_lines(SweepLines& lines, const HorizonGrid& grid, const Azimuth& azimuth);

/// Greatest distance, in steps, of a horizon from its texel.
[[nodiscard]] int farthest_sight(const HorizonGrid& grid);

/// Lines of a group: as many as a vector of this processor holds.
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
