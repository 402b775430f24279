#include "unwrap/upright.h"

#include <algorithm>
#include <tuple>

namespace rnmbake {
namespace {

using Vec2d = Imath::V2d;

constexpr std::size_t most_edges = 64;

/// Convex hull by the monotone chain (Andrew 1979), counter-clockwise.
std::vector<Vec2d> hull_of(std::vector<Vec2d> points) {
  const auto before = [](const Vec2d& a, const Vec2d& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<Vec2d> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Vec2d& point : points) {
      while (hull.size() >= first + 2 && (hull.back() - hull[hull.size() - 2]) % (point - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

struct Rectangle {
  Vec2d low, size;
};

/// In a frame with x along `axis`.
Rectangle bounds(const std::vector<Vec2d>& points, const Vec2d& axis) {
  Vec2d low(points.front() ^ axis, axis % points.front()), high = low;
  for (const Vec2d& p : points) {
    const Vec2d turned(p ^ axis, axis % p);
    low = {std::min(low.x, turned.x), std::min(low.y, turned.y)};
    high = {std::max(high.x, turned.x), std::max(high.y, turned.y)};
  }
  return {low, high - low};
}

std::vector<Vec2d> longest_edges(const std::vector<Vec2d>& hull) {
  std::vector<Vec2d> edges;
  for (std::size_t i = 0; i < hull.size(); ++i) edges.push_back(hull[(i + 1) % hull.size()] - hull[i]);
  std::stable_sort(edges.begin(), edges.end(),
                   [](const Vec2d& a, const Vec2d& b) { return a.length2() > b.length2(); });
  edges.resize(std::min(edges.size(), most_edges));
  return edges;
}

}  // namespace

Vec2d upright(std::vector<Vec2d>& points) {
  const std::vector<Vec2d> hull = hull_of(points);
  Vec2d axis(1, 0);
  double least = -1;
  for (const Vec2d& edge : longest_edges(hull)) {
    if (edge.length() == 0) continue;
    const Vec2d along = edge.normalized();
    const Vec2d size = bounds(hull, along).size;
    if (least >= 0 && size.x * size.y >= least * (1 - 1e-9)) continue;  // ties go to the longest edge
    least = size.x * size.y;
    axis = along;
  }
  if (const Vec2d size = bounds(points, axis).size; size.x > size.y) axis = {-axis.y, axis.x};
  const Rectangle box = bounds(points, axis);
  for (Vec2d& p : points) p = Vec2d(p ^ axis, axis % p) - box.low;
  return box.size;
}

}  // namespace rnmbake
