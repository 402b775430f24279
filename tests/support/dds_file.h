// tests/support/dds_file.h - blocks of a compressed texture as a file that other programs' decoders read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rnmbake {

/// By their numbers in DXGI; bc1 has four letters instead.
enum class DdsFormat : std::uint8_t { bc1 = 0, bc6h_uf16 = 95, bc6h_sf16 = 96, bc7_unorm = 98 };

/// https://learn.microsoft.com/windows/win32/direct3ddds/dds-header.
inline std::string dds_file(DdsFormat format, int width, int height,
                            const std::vector<std::uint8_t>& blocks) {
  const auto number = [](std::size_t value) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 255);
    return bytes;
  };
  const auto zeros = [](std::size_t numbers) { return std::string(4 * numbers, '\0'); };
  const bool bc1 = format == DdsFormat::bc1;
  const std::size_t caps = 1, has_height = 2, has_width = 4, has_format = 0x1000, has_size = 0x80000;
  std::string file = "DDS " + number(124) + number(caps | has_height | has_width | has_format | has_size) +
                     number(std::size_t(height)) + number(std::size_t(width)) + number(blocks.size()) +
                     zeros(13);
  file += number(32) + number(4) + (bc1 ? "DXT1" : "DX10") + zeros(5);  // the format, by its four letters
  file += number(0x1000) + zeros(4);                                    // a texture
  if (!bc1)
    file += number(std::size_t(format)) + number(3) + number(0) + number(1) + number(0);  // flat, one of them
  return file.append(blocks.begin(), blocks.end());
}

}  // namespace rnmbake
