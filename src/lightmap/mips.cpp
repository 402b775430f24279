#include "lightmap/mips.h"

#include "lightmap/fill.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rnmbake {
namespace {

/// Texels [first, last) of the finer level that lie under a texel of the coarser one, along one side.
struct Span {
  double begin = 0, end = 0;
  [[nodiscard]] int first() const { return static_cast<int>(begin); }
  [[nodiscard]] int last() const { return static_cast<int>(std::ceil(end)); }
  [[nodiscard]] double share(int texel) const {
    return std::min(end, texel + 1.0) - std::max(begin, double(texel));
  }
};

Span span_of(int texel, int coarse, int fine) {
  const double ratio = double(fine) / coarse;
  return {texel * ratio, std::min((texel + 1) * ratio, double(fine))};
}

void set_mean(const MipLevel& fine, const Span& across, const Span& down, int x, int y, MipLevel& coarse) {
  std::vector<double> sum(static_cast<std::size_t>(fine.image.channels()), 0.0);
  double weight = 0;
  for (int v = down.first(); v < down.last(); ++v) {
    for (int u = across.first(); u < across.last(); ++u) {
      const double share = across.share(u) * down.share(v);
      if (fine.coverage.texel(u, v)[0] <= 0.5F || share <= 0) continue;
      weight += share;
      const auto texel = fine.image.texel(u, v);
      for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += share * double(texel[c]);
    }
  }
  if (weight <= 0) return;
  coarse.coverage.texel(x, y)[0] = 1;
  for (std::size_t c = 0; c < sum.size(); ++c)
    coarse.image.texel(x, y)[c] = static_cast<float>(sum[c] / weight);
}

MipLevel next_level(const MipLevel& fine) {
  const int width = std::max(fine.image.width() / 2, 1), height = std::max(fine.image.height() / 2, 1);
  MipLevel coarse{{width, height, fine.image.channels()}, {width, height, 1}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      set_mean(fine, span_of(x, width, fine.image.width()), span_of(y, height, fine.image.height()), x, y,
               coarse);
  }
  return coarse;
}

}  // namespace

int mips_within(int padding) {
  return padding < 1 ? 0 : std::bit_width(static_cast<unsigned>(padding)) - 1;
}

std::vector<MipLevel> mip_levels(const FloatImage& image, const FloatImage& coverage, int count,
                                 int padding) {
  std::vector<MipLevel> levels;
  MipLevel fine{image, coverage};
  for (int level = 1; level <= count; ++level) {
    fine = next_level(fine);
    levels.push_back(fine);
    dilate(levels.back().image, fine.coverage, std::max(padding >> level, 1));
  }
  return levels;
}

}  // namespace rnmbake
