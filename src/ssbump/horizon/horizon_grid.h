// ssbump/horizon/horizon_grid.h - a height map as the sweep walks over it: step by step, many lines side by
// side.
#pragma once

#include "base/large_vector.h"
#include "ssbump/heights/height_field.h"

#include <cstddef>
#include <vector>

namespace rnmbake {

/// One axis of the map, and of what lies beyond its borders.
struct GridAxis {
  int size = 0;    // texels of the map
  int period = 0;  // after which all repeats; `size` where the border goes on
  WrapMode beyond = WrapMode::wrap;

  [[nodiscard]] bool repeats() const { return beyond != WrapMode::none; }
  /// Within the period; for axes that repeat. Mostly one period away at most: divisions are slow.
  [[nodiscard]] int fold(int i) const {
    if (i < 0) i += period;
    if (i >= period) i -= period;
    if (i >= 0 && i < period) return i;
    const int rest = i % period;
    return rest < 0 ? rest + period : rest;
  }
  /// The texel of the map at any place.
  [[nodiscard]] int texel(int i) const {
    if (i >= 0 && i < size) return i;
    return texel_beyond(i, size, beyond);
  }
};

/// Neighbours along `lines` are neighbours in memory; sweeps go along `steps`. Rows of the map go along
/// `lines` or along `steps`. The heights about the map lie in memory as well, as far as texels near the
/// border look.
struct HorizonGrid {
  const float* heights = nullptr;  // of texel (0, 0)
  std::ptrdiff_t pitch = 0;        // from step to step
  GridAxis steps, lines;
  float range = 0;  // of the heights

  [[nodiscard]] const float* row(int step) const { return at(steps.texel(step), 0); }
  [[nodiscard]] const float* at(int step, int line) const { return heights + step * pitch + line; }
};

inline constexpr int most_lines_at_once = 16;
inline constexpr float no_height = -1e30F;  // under which nothing can stand out

/// Floats from row to row: more than `least`, an odd number of cache lines, so that rows spread over all sets
/// of a cache.
[[nodiscard]] constexpr std::size_t row_pitch(std::size_t least) {
  return ((least + 15) / 16 | 1) * 16;
}

/// Without heights yet, for texels that look up to `near_rows` + 1 steps about.
[[nodiscard]] HorizonGrid make_grid(const GridAxis& steps, const GridAxis& lines, int near_rows);

/// Lays the field's heights into `memory`. `transposed`: steps go along rows.
void lay_heights(HorizonGrid& grid, const FloatImage& heights, bool transposed, int near_rows,
                 LargeVector<float>& memory);

}  // namespace rnmbake
