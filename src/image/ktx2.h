// image/ktx2.h - KTX2 files of a texture in two or three dimensions, with its mipmaps.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rnmbake {

/// By their numbers in Vulkan (VkFormat).
enum class TexelFormat : std::uint32_t {
  rgba16_sfloat = 97,
  b10g11r11_ufloat = 122,
  e5b9g9r9_ufloat = 123,
  bc6h_ufloat = 143,
  bc6h_sfloat = 144
};

struct Ktx2Texture {
  TexelFormat format = TexelFormat::rgba16_sfloat;
  std::array<std::uint32_t, 3> size{1, 1, 0};  // depth 0: two dimensions

  /// Texels or blocks, the largest level first; x fastest, z slowest, numbers in little endian. Each level
  /// has half the sides of the one before, rounded down, and 1 at least.
  std::vector<std::string> levels;

  bool zstd = false;  // each level compressed by Zstandard
};

/// Khronos, "KTX File Format Specification" 2.0; its data format descriptor: "Khronos Data Format
/// Specification" 1.3.
[[nodiscard]] std::string ktx2_of(const Ktx2Texture& texture);

}  // namespace rnmbake
