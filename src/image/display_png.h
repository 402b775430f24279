// image/display_png.h - an 8-bit picture to look at; never a carrier of light.
#pragma once

#include "image/float_image.h"

#include <filesystem>

namespace rnmbake {

/// The sRGB transfer curve (IEC 61966-2-1) of one linear value, clamped to [0, 1]; NaN becomes 0.
[[nodiscard]] float srgb_encode(float linear);

/// The way back: the linear value of an encoded one in [0, 1].
[[nodiscard]] float srgb_decode(float encoded);

/// Multiplies by 2^exposure, clamps to [0, 1], applies the sRGB curve and writes 8 bits for each channel,
/// whole or not at all. Takes 1 or 3 channels. Throws Error(io) naming the file.
void write_display_png(const std::filesystem::path& file, const FloatImage& image, float exposure);

}  // namespace rnmbake
