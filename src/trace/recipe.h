// trace/recipe.h - what the published recipe (a basis vector as a flat normal map) does to a surface in
// Cycles.
//
// The normal of the material's diffuse closure becomes the basis direction. Cycles then bends it (tilt
// clamp), darkens it (bump shadowing), uses it for bounces off the object itself (self-reflection), counts
// lamps below the face, and divides by the object's own albedo (docs/reference.md). Each can be left out.
#pragma once

#include "base/math.h"
#include "scene/surface.h"
#include "trace/gather_options.h"
#include "trace/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace rnmbake {

/// A diffuse closure; all vectors unit, on the side of the surface that was hit.
struct Closure {
  Vec3 normal;          // of the closure
  Vec3 smooth;          // the shading normal
  bool faulty = false;  // whether it is the recipe's
};

class Recipe {
 public:
  /// Throws Error(usage) where the version is no version.
  Recipe(const RecipeFaults& faults, const std::string& blender_version);

  /// `basis`: the basis direction in world space; `smooth`: shading normal; `face`: geometric normal; `wo`:
  /// towards the viewer.
  [[nodiscard]] Closure closure(const Vec3& basis, const Vec3& smooth, const Vec3& face,
                                const Vec3& wo) const;

  /// Clamped cosine of the closure, bump shadowing included.
  [[nodiscard]] float cosine(const Closure& closure, const Vec3& direction) const {
    const float plain = closure.normal.dot(direction);
    if (!(plain > 0)) return 0;
    return closure.faulty && faults_.bump_shadowing ? plain * shadowing(closure, direction) : plain;
  }
  [[nodiscard]] const RecipeFaults& faults() const { return faults_; }

 private:
  [[nodiscard]] float shadowing(const Closure& closure, const Vec3& direction) const;

  RecipeFaults faults_;
  bool microfacets_ = false;  // Blender 4.5 on: Conty Estevez et al. 2019 in place of a cubic
};

/// What a DIFFUSE bake without colour holds where a texel of this albedo receives `light`. Cycles divides the
/// reflected light by the albedo; channels of albedo 0 get the mean of the others.
[[nodiscard]] Vec3 without_color(const Vec3& light, const Vec3& albedo);

/// A target where paths from its own texels hit it again.
class OwnSurface {
 public:
  OwnSurface(const TraceScene& scene, const GatherTarget& target);

  [[nodiscard]] bool holds(const Vertex& vertex) const { return triangle_of(vertex) != absent; }
  /// World-space direction of a tangent-space vector at a vertex that it holds, on the side that was hit.
  [[nodiscard]] Vec3 direction(const Vertex& vertex, const Vec3& basis) const;
  /// Origin of a shadow ray to a light below the face, as in Cycles. `weights`: barycentric coordinates on a
  /// triangle of the surface; `start`: origin of other rays; `side`: -1 where the triangle was hit from
  /// behind.
  [[nodiscard]] Vec3 start_below(std::uint32_t triangle, const Vec3& weights, const Vec3& start,
                                 const Vec3& direction, float side = 1) const;
  [[nodiscard]] Vec3 start_below(const Vertex& vertex, const Vec3& direction) const;
  /// At a point on a triangle of the surface; `weights`: barycentric coordinates.
  [[nodiscard]] Vec3 albedo(std::uint32_t triangle, const Vec3& weights) const;

 private:
  static constexpr std::uint32_t absent = ~std::uint32_t{0};
  [[nodiscard]] std::uint32_t triangle_of(const Vertex& vertex) const;

  const TraceScene& scene_;
  const Surface& surface_;
  std::uint32_t object_;
  std::vector<std::uint32_t> materials_;  // [triangles of the surface] -> DiffuseScene::materials
  std::vector<Vec2> uv_;                  // [3 x triangles of the surface] of the material's pictures
  std::vector<std::uint32_t> of_source_;  // number of the mesh's triangle -> of the surface's
};

}  // namespace rnmbake
