#include "ssbump/map/mips.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace rnmbake {
namespace {

struct Share {
  int from = 0;
  float weight = 0;
};

/// Texels of `count` under each texel of the smaller number, weighted by overlap; weights sum to 1.
std::vector<std::vector<Share>> shares(int count) {
  const int smaller = std::max(1, count / 2);
  const double width = static_cast<double>(count) / smaller;
  std::vector<std::vector<Share>> all(static_cast<std::size_t>(smaller));
  for (int i = 0; i < smaller; ++i) {
    const double begin = i * width, end = begin + width;
    for (int from = static_cast<int>(begin); from < count && from < end; ++from) {
      const double overlap = std::min(end, from + 1.0) - std::max<double>(begin, from);
      if (overlap > 1e-9)
        all[static_cast<std::size_t>(i)].push_back({from, static_cast<float>(overlap / width)});
    }
  }
  return all;
}

}  // namespace

FloatImage half_size(const FloatImage& image) {
  const auto columns = shares(image.width()), rows = shares(image.height());
  FloatImage half(static_cast<int>(columns.size()), static_cast<int>(rows.size()), image.channels());
  for (int y = 0; y < half.height(); ++y) {
    for (int x = 0; x < half.width(); ++x) {
      const auto out = half.texel(x, y);
      for (const Share& row : rows[static_cast<std::size_t>(y)]) {
        for (const Share& column : columns[static_cast<std::size_t>(x)]) {
          const auto in = image.texel(column.from, row.from);
          for (std::size_t c = 0; c < in.size(); ++c) out[c] += row.weight * column.weight * in[c];
        }
      }
    }
  }
  return half;
}

int mip_levels(int width, int height) {
  int levels = 0;
  for (int side = std::max(width, height); side > 1; side /= 2) ++levels;
  return levels;
}

}  // namespace rnmbake
