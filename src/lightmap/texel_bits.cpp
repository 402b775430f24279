#include "lightmap/texel_bits.h"

#include <algorithm>
#include <bit>

namespace rnmbake {

std::size_t TexelBits::count() const {
  std::size_t texels = 0;
  for (const std::uint64_t word : words_) texels += static_cast<std::size_t>(std::popcount(word));
  return texels;
}

TexelBits grown(const TexelBits& bits, int texels) {
  TexelBits wide(bits.width() + 2 * texels, bits.height());
  for (int y = 0; y < bits.height(); ++y) {
    int end = 0;  // of what is set in the wide row already
    for (int x = 0; x < bits.width(); ++x) {
      if (!bits.at(x, y)) continue;
      for (end = std::max(end, x); end <= x + 2 * texels; ++end) wide.set(end, y);
    }
  }
  TexelBits all(wide.width(), bits.height() + 2 * texels);
  for (int x = 0; x < wide.width(); ++x) {
    int end = 0;
    for (int y = 0; y < wide.height(); ++y) {
      if (!wide.at(x, y)) continue;
      for (end = std::max(end, y); end <= y + 2 * texels; ++end) all.set(x, end);
    }
  }
  return all;
}

}  // namespace rnmbake
