#include "bake/texel_centres.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace rnmbake {
namespace {

/// Texel coordinates; centres are whole numbers.
struct Place {
  double x, y;
};

struct Interval {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void widen(double by) {
    low -= by;
    high += by;
  }
  /// The first and the last whole number of it that is a row or column of `count`; first > last: none.
  [[nodiscard]] double first() const { return std::max(std::ceil(low), 0.0); }
  [[nodiscard]] double last(int count) const { return std::min(std::floor(high), count - 1.0); }
};

/// Columns that the triangle reaches between two rows.
Interval columns_between(const std::array<Place, 3>& corners, double low, double high) {
  Interval columns;
  for (std::size_t i = 0; i < 3; ++i) {
    const Place &a = corners[i], &b = corners[(i + 1) % 3];
    if (a.y >= low && a.y <= high) columns.add(a.x);
    for (const double y : {low, high}) {
      if ((a.y < y) != (b.y < y)) columns.add(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  }
  return columns;
}

}  // namespace

bool may_hold_centre(const std::array<Vec2, 3>& uv, const RectSize& map) {
  std::array<Place, 3> corners{};
  Interval columns, rows;
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = {double(uv[k].x) * map.width - 0.5, double(uv[k].y) * map.height - 0.5};
    columns.add(corners[k].x);
    rows.add(corners[k].y);
  }
  columns.widen(centre_margin);
  rows.widen(centre_margin);
  if (columns.first() > columns.last(map.width)) return false;
  for (double row = rows.first(); row <= rows.last(map.height); ++row) {
    Interval near = columns_between(corners, row - centre_margin, row + centre_margin);
    near.widen(centre_margin);
    if (near.first() <= near.last(map.width)) return true;
  }
  return false;
}

void drop_between_centres(std::vector<ReceiverCorner>& corners, const RectSize& map) {
  auto kept = corners.begin();
  for (auto triangle = corners.begin(); triangle != corners.end(); triangle += 3) {
    if (may_hold_centre({triangle[0].uv, triangle[1].uv, triangle[2].uv}, map))
      kept = std::copy_n(triangle, 3, kept);
  }
  corners.erase(kept, corners.end());
  corners.shrink_to_fit();
}

}  // namespace rnmbake
