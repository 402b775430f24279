// ssbump/horizon_grid.h - a height map as the sweep walks over it: step by step, many lines side by side.
#pragma once

#include "ssbump/height_field.h"

#include <cstddef>

namespace rnmbake {

/// One axis of the map, and of what lies beyond its borders.
struct GridAxis {
  int size = 0;    // texels of the map
  int period = 0;  // after which all repeats; `size` where the border goes on
  Beyond beyond = Beyond::wrap;

  [[nodiscard]] bool repeats() const { return beyond != Beyond::none; }
  /// Within the period; for axes that repeat.
  [[nodiscard]] int fold(int i) const {
    const int rest = i % period;
    return rest < 0 ? rest + period : rest;
  }
  /// The texel of the map at any place.
  [[nodiscard]] int texel(int i) const {
    if (i >= 0 && i < size) return i;
    if (!repeats()) return i < 0 ? 0 : size - 1;
    const int part = fold(i);
    if (beyond == Beyond::wrap) return part % size;
    const int folded = part % (2 * size);
    return folded < size ? folded : 2 * size - 1 - folded;
  }
};

/// Neighbours along `lines` are neighbours in memory; sweeps go along `steps`. Rows of the map go along
/// `lines` or along `steps`: then `heights` is the transposed map.
struct HorizonGrid {
  const float* heights = nullptr;
  GridAxis steps, lines;
  bool transposed = false;

  [[nodiscard]] const float* row(int step) const {
    return heights + static_cast<std::ptrdiff_t>(steps.texel(step)) * lines.size;
  }
};

}  // namespace rnmbake
