#include "ssbump/horizon/horizon_grid.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

constexpr int square_side = 32;  // of the squares that are transposed at once

int steps_about(int near_rows) {
  return near_rows + 2;
}
int lines_about(int near_rows) {
  return steps_about(near_rows) + most_lines_at_once;
}

}  // namespace

HorizonGrid make_grid(const GridAxis& steps, const GridAxis& lines, int near_rows) {
  const auto pitch =
      row_pitch(static_cast<std::size_t>(lines.size) + 2 * std::size_t(lines_about(near_rows)));
  return {nullptr, static_cast<std::ptrdiff_t>(pitch), steps, lines, 0};
}

void lay_heights(HorizonGrid& grid, const FloatImage& heights, bool transposed, int near_rows,
                 LargeVector<float>& memory) {
  const int over = steps_about(near_rows), aside = lines_about(near_rows);
  const int steps = grid.steps.size, lines = grid.lines.size;
  memory.resize(static_cast<std::size_t>(grid.pitch) * (std::size_t(steps) + 2 * std::size_t(over)));
  float* const first = memory.data() + over * grid.pitch + aside;
  grid.heights = first;
  const auto [lowest, highest] = std::ranges::minmax(heights.data());
  grid.range = highest - lowest;
  const float* const from = heights.data().data();
  const std::ptrdiff_t by_step = transposed ? 1 : lines, by_line = transposed ? steps : 1;
  tbb::parallel_for(0, (steps + square_side - 1) / square_side, [&](int part) {
    const int last = std::min(steps, (part + 1) * square_side);
    for (int left = 0; left < lines; left += square_side) {
      for (int step = part * square_side; step < last; ++step) {
        for (int line = left; line < std::min(lines, left + square_side); ++line)
          first[step * grid.pitch + line] = from[step * by_step + line * by_line];
      }
    }
    for (int step = part * square_side; step < last; ++step) {
      float* const row = first + step * grid.pitch;
      for (int i = 1; i <= aside; ++i) row[-i] = row[grid.lines.texel(-i)];
      for (int i = 0; i < aside; ++i) row[lines + i] = row[grid.lines.texel(lines + i)];
    }
  });
  const auto copy = [&](int step) {
    std::copy_n(grid.row(step) - aside, lines + 2 * aside, first + step * grid.pitch - aside);
  };
  for (int i = 1; i <= over; ++i) copy(-i);
  for (int i = 0; i < over; ++i) copy(steps + i);
}

}  // namespace rnmbake
