// image/light_pictures.h - light in files of 8 bits for a channel: Radiance's .hdr, and RGBM in a PNG.
#pragma once

#include "image/float_image.h"

#include <filesystem>

namespace rnmbake {

/// Radiance's picture format: three mantissas of 8 bits, rounded to the nearest, and the exponent that they
/// share; what is below 0 becomes 0. Three channels. Written whole or not at all. Throws Error(io).
void write_hdr(const std::filesystem::path& file, const FloatImage& image);

/// What Unity's RGBM lightmaps hold in a project of linear colours: 5 in gamma space, which is 5^2.2.
inline constexpr float rgbm_range = 34.493242F, rgbm_gamma = 2.2F;

/// Writes a PNG of four channels: colour is sRGB-coded, and light is its linear value times
/// rgbm_range a^rgbm_gamma for the alpha a. Values are clamped to 0 and the range. Three channels. Whole or
/// not at all. Throws Error(io).
void write_rgbm(const std::filesystem::path& file, const FloatImage& image);

/// The light of such a file. Throws as PictureReader.
[[nodiscard]] FloatImage read_rgbm(const std::filesystem::path& file);

}  // namespace rnmbake
