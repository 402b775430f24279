// lightmap/fill.h - gives texels without a value the mean of their neighbours, ring by ring.
#pragma once

#include "image/float_image.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rnmbake {

/// One entry for each texel, row by row from the top; not 0 means yes.
using TexelMask = std::vector<std::uint8_t>;

/// Texels whose centre lies in a face.
[[nodiscard]] TexelMask covered_mask(const FloatImage& coverage);

/// In each pass every `fillable` texel that touches (8 neighbours, picture borders do not wrap) one with a
/// value takes the mean of all neighbours that had a value before the pass, and has a value from then on.
/// Texels that are already `filled` never change. Any size, 1xN included; the work of all passes together is
/// O(texels). Returns how many texels were filled.
std::size_t fill_from_neighbours(FloatImage& image, TexelMask filled, const TexelMask& fillable,
                                 std::size_t passes);

/// Fills uncovered texels from covered ones, `passes` texels outwards, so that bilinear lookups and mipmaps
/// at chart borders see light and not background. NaN and Inf are never spread.
void dilate(FloatImage& image, const FloatImage& coverage, int passes);

/// The same as far as the picture goes, for readers that look between the centres of texels: faces may lie
/// there. Without a covered texel the image stays.
void dilate_everywhere(FloatImage& image, const FloatImage& coverage);

}  // namespace rnmbake
