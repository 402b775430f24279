// ssbump/heights/height_field.h - a height map as the surface that light falls on.
#pragma once

#include "image/float_image.h"

#include <cstdint>

namespace rnmbake {

/// Heights beyond a border, for each axis: the map again, the map mirrored (with the border's texels twice),
/// or the border's heights, which go on.
enum class WrapMode : std::uint8_t { wrap, mirror, none };

/// The row or column, of `size`, whose heights lie at `i`, which may be any distance beyond a border.
[[nodiscard]] constexpr int texel_beyond(int i, int size, WrapMode beyond) {
  if (i >= 0 && i < size) return i;
  if (beyond == WrapMode::none) return i < 0 ? 0 : size - 1;
  const int period = beyond == WrapMode::mirror ? 2 * size : size;
  // A map has texels. NOLINTNEXTLINE(clang-analyzer-core.DivideZero)
  const int rest = i % period, folded = rest < 0 ? rest + period : rest;
  return folded < size ? folded : period - 1 - folded;
}

/// Heights in texels (the distance of two neighbours is 1), one channel, row 0 on top. The surface is made of
/// bilinear patches between texel centres. Tangent space is right-handed: +x to the right, +y UP the picture
/// (towards row 0), +z out of it.
struct HeightField {
  FloatImage heights;
  WrapMode x = WrapMode::wrap, y = WrapMode::wrap;

  [[nodiscard]] int width() const { return heights.width(); }
  [[nodiscard]] int height() const { return heights.height(); }
};

}  // namespace rnmbake
