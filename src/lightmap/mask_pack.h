// lightmap/mask_pack.h - lays masks on as few pages as go, so that they lie in the holes of each other.
#pragma once

#include "lightmap/texel_bits.h"

#include <cstddef>
#include <vector>

namespace rnmbake {

struct MaskPlan {
  struct Page {
    int width = 0, height = 0;  // texels
  };
  struct Place {
    std::size_t page = 0;
    int x = 0, y = 0;  // of the mask's upper left corner, from the page's
  };
  std::vector<Page> pages;
  std::vector<Place> places;  // [masks], in the order given
};

/// Places masks, without turning them, so that no two share a texel, on pages of at most `side` x `side`
/// texels. Each mask takes the first place from the top, then from the left, where it fits; of some orders of
/// the masks and some widths of the page the smallest page counts, or, where one cannot hold all, the fullest
/// (as many of these are tried as a count of steps allows, so that the result is the same everywhere). Sides
/// are multiples of 4, a compressed block's, where `side` is one. Throws std::invalid_argument where a mask's
/// rectangle is larger than a page.
[[nodiscard]] MaskPlan pack_masks(const std::vector<TexelBits>& masks, int side);

}  // namespace rnmbake
