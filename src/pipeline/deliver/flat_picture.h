// pipeline/deliver/flat_picture.h - the flat light of a page as the 8 bits that a .glb can hold.
#pragma once

#include "image/metrics.h"
#include "pipeline/deliver/pages.h"

#include <filesystem>
#include <vector>

namespace rnmbake {

/// The value that becomes white in the pictures of all pages, which have one layer, the flat light: the least
/// that no more than a thousandth of the covered values pass, and the greatest where that is within a factor
/// of two. At least 1e-6.
[[nodiscard]] float white_of(const std::vector<Page>& pages);

/// Writes a PNG, sRGB-coded, of the page's values over `white`; returns what is lost by that over the covered
/// texels, in E/pi.
[[nodiscard]] PictureMetrics write_flat_picture(const std::filesystem::path& file, const Page& page,
                                                float white);

}  // namespace rnmbake
