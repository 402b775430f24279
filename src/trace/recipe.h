// trace/recipe.h - what the published recipe (a basis vector as a flat normal map) does to a surface in
// Cycles.
//
// The material's diffuse closure gets the basis normal in place of the surface's. Cycles then bends it (tilt
// clamp), darkens it (bump shadowing), uses it for the object's own bounces too (self-reflection), lets lamps
// in that stand below the face, and divides by the object's own albedo (docs/reference.md). Each can be left
// out.
#pragma once

#include "base/math.h"
#include "scene/surface.h"
#include "trace/gather_options.h"
#include "trace/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace rnmbake {

/// A diffuse closure at a place; all vectors unit, on the side that the place is seen from.
struct Closure {
  Vec3 normal;          // of the closure
  Vec3 smooth;          // the shading normal
  bool faulty = false;  // whether the recipe has a hand in it
};

class Recipe {
 public:
  /// Throws Error(usage) where the version is no version.
  Recipe(const RecipeFaults& faults, const std::string& blender_version);

  /// `bent`: the basis normal in world space; `face`: geometric; `towards`: where the place is seen from.
  [[nodiscard]] Closure closure(const Vec3& bent, const Vec3& smooth, const Vec3& face, const Vec3& wo) const;

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

/// What a DIFFUSE bake without colour holds where a texel of this albedo receives `light`. Cycles divides
/// what is sent back by the albedo; colours that the albedo lacks get the mean of those that it has.
[[nodiscard]] Vec3 without_color(const Vec3& light, const Vec3& albedo);

/// A target as the rays of its own texels meet it, for one basis vector.
class OwnSurface {
 public:
  OwnSurface(const TraceScene& scene, const GatherTarget& target);

  [[nodiscard]] bool holds(const Vertex& vertex) const { return place_of(vertex) != absent; }
  /// World-space direction of a tangent-space vector at a vertex that it holds, on the side that is seen.
  [[nodiscard]] Vec3 direction(const Vertex& vertex, const Vec3& basis) const;
  /// Where a ray to a light under the face starts in Cycles. `weights`: barycentric, on a triangle of the
  /// surface; `start`: where other rays from there do; `side`: -1 where the triangle is seen from behind.
  [[nodiscard]] Vec3 start_below(std::uint32_t triangle, const Vec3& weights, const Vec3& start,
                                 const Vec3& direction, float side = 1) const;
  [[nodiscard]] Vec3 start_below(const Vertex& vertex, const Vec3& direction) const;
  /// At a place on a triangle of the surface; `weights`: barycentric.
  [[nodiscard]] Vec3 albedo(std::uint32_t triangle, const Vec3& weights) const;

 private:
  static constexpr std::uint32_t absent = ~std::uint32_t{0};
  [[nodiscard]] std::uint32_t place_of(const Vertex& vertex) const;

  const TraceScene& scene_;
  const Surface& surface_;
  std::uint32_t object_;
  std::vector<std::uint32_t> materials_;  // [triangles of the surface] -> DiffuseScene::materials
  std::vector<Vec2> uv_;                  // [3 x triangles of the surface] of the material's pictures
  std::vector<std::uint32_t> of_source_;  // number of the mesh's triangle -> of the surface's
};

}  // namespace rnmbake
