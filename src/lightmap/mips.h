// lightmap/mips.h - mipmaps that mean the light of surfaces alone.
#pragma once

#include "image/float_image.h"

#include <vector>

namespace rnmbake {

struct MipLevel {
  FloatImage image, coverage;
};

/// Mipmaps that texels around charts, `padding` wide, suffice for: n for 2^n.
[[nodiscard]] int mips_within(int padding);

/// `count` levels below `image`, each with half the sides, rounded down, and 1 at least. A texel is the mean
/// of the covered texels under it, weighted by how much of each lies there, and covered where there is one;
/// texels around are filled from these, `padding` texels of the first level wide.
[[nodiscard]] std::vector<MipLevel> mip_levels(const FloatImage& image, const FloatImage& coverage, int count,
                                               int padding);

}  // namespace rnmbake
