// pipeline/deliver/page_format.h - the formats that the pages of a delivery can have, by the names that users
// type.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace rnmbake {

/// exr: half floats. hdr: Radiance's. png_rgbm: 8 bits (image/light_pictures.h). The others are KTX2 files,
/// with mipmaps: half floats with an alpha of 1, packed floats, blocks.
enum class PageFormat : std::uint8_t {
  exr,
  hdr,
  png_rgbm,
  ktx2_rgba16f,
  ktx2_b10g11r11,
  ktx2_e5b9g9r9,
  ktx2_bc6h
};

/// Every format, in the order of --help.
[[nodiscard]] const std::vector<PageFormat>& page_formats();

[[nodiscard]] const char* name_of(PageFormat format);

/// Throws Error(usage) for a name that is none.
[[nodiscard]] PageFormat page_format(std::string_view name);

/// What files of it end in, with the point.
[[nodiscard]] const char* ending_of(PageFormat format);

[[nodiscard]] bool is_ktx2(PageFormat format);

/// Layers of some encodings have values below 0.
[[nodiscard]] bool holds_negative(PageFormat format);

/// How pages are written.
struct PageForm {
  PageFormat format = PageFormat::exr;
  int mips = 0;       // levels below the first one; of ktx2
  bool zstd = false;  // of ktx2: compressed by Zstandard
  int padding = 4;    // texels around surfaces that are filled from them
};

}  // namespace rnmbake
