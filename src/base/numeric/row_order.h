// base/numeric/row_order.h - rows counted from the top, as pictures store them, and from the bottom, as
// texture coordinates and Blender do.
#pragma once

namespace rnmbake {

/// Row of the same texels counted from the other end of a picture of `height` rows.
[[nodiscard]] constexpr int other_row(int row, int height) {
  return height - 1 - row;
}

}  // namespace rnmbake
