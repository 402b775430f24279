// image/vtf.h - VTF, the texture files of Source, of one picture of half floats.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace rnmbake {

struct VtfTexture {
  int width = 0, height = 0;    // below 65536; Source wants powers of two
  std::string_view texels;      // R, G, B, A of 16 bits each, rows from the top
  std::array<float, 3> mean{};  // of R, G and B: "reflectivity"
};

/// A header of version 7.2, and the texels (RGBA16161616F); clamped, one level, no thumbnail. Layout: "VTF
/// (Valve Texture Format)", Valve Developer Community.
[[nodiscard]] std::string vtf_of(const VtfTexture& texture);

/// Bytes of such a file.
[[nodiscard]] std::size_t vtf_size(int width, int height);

}  // namespace rnmbake
