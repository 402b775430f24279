#include "unwrap/chart_samples.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rnmbake {
namespace {

using Vec2d = Imath::V2d;

/// Where the edge crosses a row; the same bits whichever triangle asks.
double crossing(const Vec2d& a, const Vec2d& b, double y) {
  const bool in_order = a.y < b.y || (a.y == b.y && a.x < b.x);
  const Vec2d &low = in_order ? a : b, &high = in_order ? b : a;
  return low.x + (y - low.y) * (high.x - low.x) / (high.y - low.y);
}

std::int64_t first_sample(double from) {
  return static_cast<std::int64_t>(std::ceil(from - 0.5));
}

/// Calls visit(tile, bits) for every run of samples in a triangle; ends when it returns false.
template <typename Visit>
bool visit_row(std::int64_t row, std::int64_t left, std::int64_t right, const Visit& visit) {
  while (left < right) {
    const std::int64_t end = std::min(right, ((left >> 3) + 1) << 3);
    const std::uint64_t run = (std::uint64_t{1} << (end - left)) - 1;
    const std::uint64_t bits = run << ((row & 7) * 8 + (left & 7));
    const std::uint64_t tile =
        (static_cast<std::uint64_t>(row >> 3) << 32) | static_cast<std::uint32_t>(left >> 3);
    if (!visit(tile, bits)) return false;
    left = end;
  }
  return true;
}

template <typename Visit>
bool visit_triangle(const Vec2d* c, const Visit& visit) {
  const auto [low, high] = std::minmax({c[0].y, c[1].y, c[2].y});
  for (std::int64_t row = first_sample(low); row < first_sample(high); ++row) {
    const double y = static_cast<double>(row) + 0.5;
    std::array<double, 3> x{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2d &a = c[i], &b = c[(i + 1) % 3];
      if ((a.y <= y) != (b.y <= y)) x[count++] = crossing(a, b, y);
    }
    if (count != 2) continue;
    const auto [left, right] = std::minmax(x[0], x[1]);
    if (!visit_row(row, first_sample(left), first_sample(right), visit)) return false;
  }
  return true;
}

template <typename Visit>
bool visit_all(const std::vector<Vec2d>& corners, const Visit& visit) {
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    if (!visit_triangle(&corners[i], visit)) return false;
  }
  return true;
}

}  // namespace

bool ChartSamples::any(const std::vector<Vec2d>& corners) const {
  return !visit_all(corners, [&](std::uint64_t tile, std::uint64_t bits) {
    const auto found = tiles_.find(tile);
    return found == tiles_.end() || (found->second & bits) == 0;
  });
}

void ChartSamples::add(const std::vector<Vec2d>& corners) {
  visit_all(corners, [&](std::uint64_t tile, std::uint64_t bits) {
    tiles_[tile] |= bits;
    return true;
  });
}

}  // namespace rnmbake
