// texture/block_compression.h - what textures look like after a graphics card's compressed formats.
#pragma once

#include "image/float_image.h"

#include <cstdint>
#include <vector>

namespace rnmbake {

/// rgb8: 8 bits each; rgb565: 5, 6 and 5; bc1 (DXT1): two 565 colours and two between for 4 x 4 texels; bc7:
/// the best of its modes 6 (one line through the colours, 16 steps), 5 and 4 (one channel, whichever, on its
/// own).
enum class TextureFormat : std::uint8_t { rgb8, rgb565, bc1, bc7 };

[[nodiscard]] const char* name_of(TextureFormat format);
[[nodiscard]] double bits_per_texel(TextureFormat format);

/// The first three channels, compressed and read again as the format's specification says; values are clamped
/// to [0, 1]. Blocks at odd borders repeat the last texel. The encoders look for the least squared error: end
/// points along the principal axis, refined by least squares; their blocks are what a good encoder writes,
/// not the best there is.
[[nodiscard]] FloatImage through(TextureFormat format, const FloatImage& image);

/// The blocks that `through` is the sight of, row by row from the top, as a DDS file holds them; of bc1 and
/// bc7.
[[nodiscard]] std::vector<std::uint8_t> blocks_of(TextureFormat format, const FloatImage& image);

}  // namespace rnmbake
