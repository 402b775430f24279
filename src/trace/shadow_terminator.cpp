#include "trace/shadow_terminator.h"

#include <algorithm>

namespace rnmbake {
namespace {

/// Twice the height of a paraboloid that leaves each edge as steeply as its corners' normals say.
float paraboloid(const SmoothTriangle& triangle, const Vec3& weights) {
  float height = 0;
  for (int i = 0; i < 3; ++i) {
    const auto a = static_cast<std::size_t>(i), b = (a + 1) % 3;
    const Vec3 edge = triangle.positions[b] - triangle.positions[a];
    height += weights[i] * weights[(i + 1) % 3] * edge.dot(triangle.normals[b] - triangle.normals[a]);
  }
  return height;
}

/// How far a place lies under the planes across the corners' normals, each raised until the triangle is under
/// it; the least of the three.
float room(const SmoothTriangle& triangle, const Vec3& place) {
  std::array<float, 3> rooms{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto over = [&](const Vec3& point) {
      return (point - triangle.positions[k]).dot(triangle.normals[k]);
    };
    const float raised =
        std::max({0.0F, over(triangle.positions[(k + 1) % 3]), over(triangle.positions[(k + 2) % 3])});
    rooms[k] = std::max(0.0F, raised - over(place));
  }
  return *std::min_element(rooms.begin(), rooms.end());
}

}  // namespace

Vec3 terminator_offset(const SmoothTriangle& triangle, const Vec3& weights) {
  Vec3 place(0), normal(0);
  for (int k = 0; k < 3; ++k) {
    place += triangle.positions[static_cast<std::size_t>(k)] * weights[k];
    normal += triangle.normals[static_cast<std::size_t>(k)] * weights[k];
  }
  return normal * std::max(room(triangle, place), paraboloid(triangle, weights) / 2);
}

}  // namespace rnmbake
