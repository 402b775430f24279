// image/sample.h - values between texels: bilinear lookup by UV.
#pragma once

#include "base/math.h"
#include "image/float_image.h"

#include <array>
#include <span>

namespace rnmbake {

enum class Border { clamp, wrap };

/// The row or column, of `size`, that stands for `i`, any distance beyond a border.
[[nodiscard]] constexpr int texel_within(int i, int size, Border border) {
  if (i >= 0 && i < size) return i;
  if (border == Border::clamp) return i < 0 ? 0 : size - 1;
  const int rest = i % size;
  return rest < 0 ? rest + size : rest;
}

/// One texel's part in a bilinear lookup.
struct Tap {
  int x = 0, y = 0;
  float weight = 0;
};

/// The UV of a texel's centre; v runs up, row 0 is on top.
[[nodiscard]] Vec2 texel_uv(const FloatImage& image, int x, int y);

/// The four texels around `uv`. Weights sum to 1; at a texel's centre its weight is exactly 1 and the others
/// exactly 0, so that a NaN next door stays there.
[[nodiscard]] std::array<Tap, 4> bilinear_taps(const FloatImage& image, const Vec2& uv, Border border);

/// Leaves out the taps where `coverage` (one channel, same size) is 0, and rescales the rest to sum to 1.
/// Where none is covered the taps come back as they are.
[[nodiscard]] std::array<Tap, 4> covered_taps(std::array<Tap, 4> taps, const FloatImage& coverage);

/// Weighted sum of the taps' texels, one value for each channel of `out`.
void sample(const FloatImage& image, const std::array<Tap, 4>& taps, std::span<float> out);

/// The same of the first three channels.
[[nodiscard]] Vec3 sampled_vec3(const FloatImage& image, const std::array<Tap, 4>& taps);

}  // namespace rnmbake
