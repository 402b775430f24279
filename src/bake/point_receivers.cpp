#include "bake/point_receivers.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rnmbake {
namespace {

/// Corners around the centre, which has weights 1/4, 1/4, 1/2: inside, so that no rounding of UVs moves it
/// out.
constexpr std::array<std::array<int, 2>, 3> corners{{{-1, -1}, {1, -1}, {0, 1}}};
constexpr double uv_reach = 0.4;  // texels from the centre of the texel to the corners, along each axis

}  // namespace

std::array<ReceiverCorner, 3> point_receiver(const Vec3d& point, const Vec3& direction, double size,
                                             std::size_t texel, const RectSize& map) {
  const FaceAxes axes = face_axes(direction);
  const auto width = static_cast<std::size_t>(map.width);
  const double x = double(texel % width) + 0.5, y = double(texel / width) + 0.5;
  std::array<ReceiverCorner, 3> out;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [u, v] = corners[k];
    const Vec3d place = point + Vec3d(axes.t1) * (size * u) + Vec3d(axes.t2) * (size * v);
    out[k] = {Vec3(place), direction,
              Vec2(float((x + uv_reach * u) / map.width), float((y + uv_reach * v) / map.height))};
  }
  return out;
}

RectSize point_map(std::size_t points) {
  const auto width = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(points))));
  if (width == 0) return {};
  return {static_cast<int>(width), static_cast<int>((points + width - 1) / width)};
}

double point_receiver_size(const Vec3d& point, int steps_log2) {
  const double largest = std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)});
  return std::max(1e-6, std::ldexp(largest, steps_log2 - 23));
}

ReceiverPasses make_point_receivers(std::span<const Vec3d> points, std::span<const Vec3> directions) {
  const RectSize map = point_map(points.size());
  ReceiverPasses result;
  for (std::size_t d = 0; d < directions.size(); ++d) {
    std::vector<ReceiverCorner> triangles;
    triangles.reserve(3 * points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto three = point_receiver(points[i], directions[d], point_receiver_size(points[i]), i, map);
      triangles.insert(triangles.end(), three.begin(), three.end());
    }
    result.passes.push_back({ReceiverPass::Role::basis, d, std::move(triangles)});
  }
  return result;
}

}  // namespace rnmbake
