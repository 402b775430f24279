// bake/atlas.h - places many rectangles into as few pictures as a limit allows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rnmbake {

struct RectSize {
  int width = 0, height = 0;  // texels
};

struct Placement {
  std::size_t atlas = 0;
  int x = 0, y = 0;  // texel of the rectangle's lower left corner
};

struct AtlasPlan {
  std::vector<RectSize> atlases;
  std::vector<Placement> placements;  // [rects], in the order given
};

/// Skyline packing (stb_rect_pack), tallest first, the same everywhere. No atlas has more than `max_pixels`
/// unless a single rectangle alone does; a single rectangle gets an atlas of its own size.
[[nodiscard]] AtlasPlan pack(const std::vector<RectSize>& rects, std::int64_t max_pixels);

}  // namespace rnmbake
