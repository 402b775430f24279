// bench/cobbles.h - a height map to measure on: cobbles under fractal noise, the same on every machine.
#pragma once

#include "ssbump/heights/height_field.h"

namespace rnmbake {

/// Smooth noise, each octave half as wide and as high as the one before, down to 2 texels; in [0, 1), the
/// same again after `side` texels, which should be a multiple of 64.
[[nodiscard]] double fractal_noise(int x, int y, int side);

/// side x side texels that repeat without a seam, heights from 0 to `range` texels. Stones are some 64 texels
/// wide at any side, which should be a multiple of 64.
[[nodiscard]] HeightField cobbles(int side, float range);

}  // namespace rnmbake
