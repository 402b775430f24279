// pipeline/deliver/flat_picture.h - the flat light of a page as the 8 bits that a .glb can hold.
#pragma once

#include "image/float_image.h"
#include "image/layered_exr.h"
#include "image/metrics.h"

#include <filesystem>
#include <vector>

namespace rnmbake {

/// The value that becomes white in the pictures of all pages: the least one that no more than a thousandth of
/// the covered values pass, and all of them where that is within a factor of two. At least 1e-6.
[[nodiscard]] float white_of(const std::vector<const FloatImage*>& flat,
                             const std::vector<const FloatImage*>& coverage);

/// Writes a PNG, sRGB-coded, of values over `white`; returns what is lost by that over the covered texels, in
/// E/pi.
[[nodiscard]] PictureMetrics write_flat_picture(const std::filesystem::path& file, const FloatImage& flat,
                                                const FloatImage& coverage, float white);

}  // namespace rnmbake
