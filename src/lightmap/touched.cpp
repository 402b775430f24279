#include "lightmap/touched.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace rnmbake {
namespace {

constexpr double rounding = 1.0 / 256;  // texels

using Corners = std::array<Imath::V2d, 3>;  // texels, y down

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }

  /// The middle where nothing would be left.
  void shrink() {
    const double middle = 0.5 * (low + high);
    low = std::min(low + rounding, middle);
    high = std::max(high - rounding, middle);
  }

  [[nodiscard]] int first() const { return static_cast<int>(std::floor(std::clamp(low, 0.0, 1e9))); }
  [[nodiscard]] int last(int count) const {
    return static_cast<int>(std::floor(std::clamp(high, -1.0, count - 1.0)));
  }
};

/// What the triangle has between two heights, along x.
Range within(const Corners& corners, double top, double bottom) {
  Range range;
  for (std::size_t i = 0; i < 3; ++i) {
    const Imath::V2d &a = corners[i], &b = corners[(i + 1) % 3];
    if (a.y >= top && a.y <= bottom) range.add(a.x);
    for (const double y : {top, bottom})
      if ((a.y < y) != (b.y < y)) range.add(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
  }
  return range;
}

void set_triangle(const Corners& corners, TexelBits& texels) {
  Range rows;
  for (const Imath::V2d& corner : corners) rows.add(corner.y);
  rows.shrink();
  for (int y = rows.first(); y <= rows.last(texels.height()); ++y) {
    Range columns = within(corners, std::max(rows.low, double(y)), std::min(rows.high, y + 1.0));
    if (columns.low > columns.high) continue;
    columns.shrink();
    for (int x = columns.first(); x <= columns.last(texels.width()); ++x) texels.set(x, y);
  }
}

}  // namespace

void set_touched(const std::vector<Vec2>& corner_uv, TexelBits& texels) {
  for (std::size_t i = 0; i + 2 < corner_uv.size(); i += 3) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2& uv = corner_uv[i + k];
      corners[k] = {double(uv.x) * texels.width(), (1 - double(uv.y)) * texels.height()};
    }
    set_triangle(corners, texels);
  }
}

}  // namespace rnmbake
