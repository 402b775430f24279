#include "trace/shadow_terminator.h"

#include <algorithm>

namespace rnmbake {
namespace {

/// Twice the height of the paraboloid whose slopes along the edges follow from the corners' normals.
float paraboloid(const SmoothTriangle& triangle, const Vec3& weights) {
  float height = 0;
  for (int i = 0; i < 3; ++i) {
    const auto a = static_cast<std::size_t>(i), b = (a + 1) % 3;
    const Vec3 edge = triangle.positions[b] - triangle.positions[a];
    height += weights[i] * weights[(i + 1) % 3] * edge.dot(triangle.normals[b] - triangle.normals[a]);
  }
  return height;
}

/// Least distance of a point below three planes: each is perpendicular to a corner's normal, and raised until
/// the triangle lies below it.
float depth_below_planes(const SmoothTriangle& triangle, const Vec3& position) {
  std::array<float, 3> depths{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto over = [&](const Vec3& point) {
      return (point - triangle.positions[k]).dot(triangle.normals[k]);
    };
    const float raised =
        std::max({0.0F, over(triangle.positions[(k + 1) % 3]), over(triangle.positions[(k + 2) % 3])});
    depths[k] = std::max(0.0F, raised - over(position));
  }
  return *std::min_element(depths.begin(), depths.end());
}

}  // namespace

Vec3 terminator_offset(const SmoothTriangle& triangle, const Vec3& weights) {
  Vec3 position(0), normal(0);
  for (int k = 0; k < 3; ++k) {
    position += triangle.positions[static_cast<std::size_t>(k)] * weights[k];
    normal += triangle.normals[static_cast<std::size_t>(k)] * weights[k];
  }
  return normal * std::max(depth_below_planes(triangle, position), paraboloid(triangle, weights) / 2);
}

}  // namespace rnmbake
