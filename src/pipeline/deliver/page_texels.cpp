#include "pipeline/deliver/page_texels.h"

#include "base/bytes.h"
#include "image/packed_floats.h"
#include "lightmap/half_range.h"
#include "texture/bc6h.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <half.h>
#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

EncodedTexels as_halves(FloatImage image) {
  (void)clamp_to_half(image);
  EncodedTexels texels;
  texels.bytes.reserve(8 * image.texels());
  for (std::size_t i = 0; i < image.data().size(); i += 3) {
    for (std::size_t c = 0; c < 3; ++c) {
      const half value = image.data()[i + c];
      put(texels.bytes, value.bits());
      image.data()[i + c] = value;
    }
    put(texels.bytes, half(1.0F).bits());
  }
  texels.seen = std::move(image);
  return texels;
}

EncodedTexels packed(FloatImage image, std::uint32_t (*pack)(const Vec3&), Vec3 (*unpack)(std::uint32_t)) {
  EncodedTexels texels;
  texels.bytes.reserve(4 * image.texels());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const std::uint32_t bits = pack(vec3_at(image, x, y));
      put(texels.bytes, bits);
      set_vec3(image, x, y, unpack(bits));
    }
  }
  texels.seen = std::move(image);
  return texels;
}

EncodedTexels as_blocks(const FloatImage& image, bool is_signed) {
  constexpr int side = 4;
  std::vector<std::vector<std::uint8_t>> rows(static_cast<std::size_t>((image.height() + side - 1) / side));
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t row) {
    rows[row] = bc6h_block_row(image, static_cast<int>(row), is_signed);
  });
  std::vector<std::uint8_t> blocks;
  for (const std::vector<std::uint8_t>& row : rows) blocks.insert(blocks.end(), row.begin(), row.end());
  return {{blocks.begin(), blocks.end()}, bc6h_decoded(blocks, image.width(), image.height(), is_signed)};
}

}  // namespace

EncodedTexels encode_texels(TexelFormat format, const FloatImage& image) {
  switch (format) {
    case TexelFormat::b10g11r11_ufloat:
      return packed(image, pack_b10g11r11, unpack_b10g11r11);
    case TexelFormat::e5b9g9r9_ufloat:
      return packed(image, pack_e5b9g9r9, unpack_e5b9g9r9);
    case TexelFormat::bc6h_ufloat:
      return as_blocks(image, false);
    case TexelFormat::bc6h_sfloat:
      return as_blocks(image, true);
    case TexelFormat::rgba16_sfloat:
      break;
  }
  return as_halves(image);
}

}  // namespace rnmbake
