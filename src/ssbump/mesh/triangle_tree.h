// ssbump/mesh/triangle_tree.h - Embree's tree over plain triangles: nearest hits and occlusion.
#pragma once

#include "base/math.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace rnmbake {

class EmbreeScene;

/// Hit of a ray.
struct TriangleHit {
  std::uint32_t triangle = 0;
  float distance = 0;
  float b1 = 0, b2 = 0;  // barycentric weights of the second and the third corner
};

/// Queries are thread-safe. Directions are unit vectors.
class TriangleTree {
 public:
  /// `corners`: three for each triangle; they are copied. Throws Error(environment) where Embree fails.
  explicit TriangleTree(const std::vector<Vec3>& corners);
  ~TriangleTree();
  TriangleTree(const TriangleTree&) = delete;
  TriangleTree& operator=(const TriangleTree&) = delete;

  /// Nearest triangle with `near` < distance <= `far`.
  [[nodiscard]] std::optional<TriangleHit> first(const Vec3& origin, const Vec3& direction, float near,
                                                 float far) const;
  [[nodiscard]] bool blocked(const Vec3& origin, const Vec3& direction, float far) const;

 private:
  std::unique_ptr<EmbreeScene> embree_;
};

}  // namespace rnmbake
