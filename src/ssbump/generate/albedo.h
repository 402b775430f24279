// ssbump/generate/albedo.h - albedo out of a colour texture, and weights multiplied by it.
#pragma once

#include "image/float_image.h"

#include <filesystem>

namespace rnmbake {

/// Luminance, linear, in [0, 1], one channel. Integer formats are taken as sRGB, floats as linear. Throws
/// Error(invalid_input) where the size is not this one.
[[nodiscard]] FloatImage read_albedo(const std::filesystem::path& file, int width, int height);

/// Multiplies all channels of rows of weights but the ambient one by the albedo, evenly; `first_row` is the
/// picture's row that row 0 of `rows` is.
void modulate_rows(FloatImage& rows, const FloatImage& albedo, int first_row);

}  // namespace rnmbake
