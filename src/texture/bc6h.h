// texture/bc6h.h - colours of high range in a graphics card's compressed format: BC6H, 16 bytes for 4 x 4
// texels.
#pragma once

#include "image/float_image.h"

#include <cstdint>
#include <span>
#include <vector>

namespace rnmbake {

/// Of one row of blocks, 0 on top; the first three channels. Values beyond half floats are clamped, and those
/// below 0 where the format has no sign; blocks at odd borders repeat the last texel. All blocks are of one
/// line (modes 11 to 14): end points along the principal axis of the half floats' bits, between which the
/// format interpolates, refined by least squares. What is made small is the squared error of light, in each
/// texel relative to its own brightness (or a sixteenth of the block's, where that is more).
[[nodiscard]] std::vector<std::uint8_t> bc6h_block_row(const FloatImage& image, int row, bool is_signed);

/// All rows.
[[nodiscard]] std::vector<std::uint8_t> bc6h_blocks(const FloatImage& image, bool is_signed);

/// Three channels, bit for bit what a graphics card sees. Throws std::invalid_argument where there are too
/// few blocks, or one of two lines.
[[nodiscard]] FloatImage bc6h_decoded(std::span<const std::uint8_t> blocks, int width, int height,
                                      bool is_signed);

}  // namespace rnmbake
