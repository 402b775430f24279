#include "image/vtf.h"

#include "base/bytes.h"

#include <cstdint>

namespace rnmbake {
namespace {

constexpr std::size_t header_bytes = 80, texel_bytes = 8;

constexpr std::uint32_t clamp_s = 0x4, clamp_t = 0x8, no_mips = 0x100, no_lower_detail = 0x200;
constexpr std::uint32_t rgba16161616f = 24, no_format = 0xFFFFFFFF;

}  // namespace

std::size_t vtf_size(int width, int height) {
  return header_bytes + texel_bytes * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

std::string vtf_of(const VtfTexture& texture) {
  std::string file;
  file.reserve(header_bytes + texture.texels.size());
  file.append("VTF\0", 4);
  put(file, std::array<std::uint32_t, 3>{7, 2, header_bytes});
  put(file,
      std::array{static_cast<std::uint16_t>(texture.width), static_cast<std::uint16_t>(texture.height)});
  put(file, clamp_s | clamp_t | no_mips | no_lower_detail);
  put(file, std::array<std::uint16_t, 2>{1, 0});  // frames, the first of them
  put(file, std::uint32_t{0});
  put(file, texture.mean);
  put(file, std::uint32_t{0});
  put(file, 1.0F);  // scale of bumps
  put(file, rgba16161616f);
  put(file, std::uint8_t{1});  // levels
  put(file, no_format);        // of the thumbnail, whose sides are next
  put(file, std::array<std::uint8_t, 2>{0, 0});
  put(file, std::uint16_t{1});  // depth
  file.resize(header_bytes, '\0');
  return file.append(texture.texels);
}

}  // namespace rnmbake
