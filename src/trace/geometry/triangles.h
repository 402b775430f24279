// trace/geometry/triangles.h - every triangle of a scene in world space, as flat arrays.
#pragma once

#include "base/math.h"
#include "scene/diffuse_scene.h"

#include <cstdint>
#include <vector>

namespace rnmbake {

/// Corners run anti-clockwise seen from the front. Normals are smooth shading normals, unit, world space.
struct Triangles {
  std::vector<Vec3> position;           // [3 x triangles]
  std::vector<Vec3> normal;             // [3 x triangles]
  std::vector<Vec2> uv;                 // [3 x triangles] of the material's pictures; (0,0) where it has none
  std::vector<std::uint32_t> material;  // [triangles] -> DiffuseScene::materials
  std::vector<std::uint32_t> object;    // [triangles] -> SceneSurvey::objects
  std::vector<std::uint32_t> source;    // [triangles]: number of the mesh's triangle

  [[nodiscard]] std::size_t size() const { return material.size(); }
};

/// Centre of the bounding box of all objects that block light, world space.
[[nodiscard]] Vec3d middle_of(const DiffuseScene& scene);

/// All objects that block light, in order, relative to `origin`. Triangles without area or with a corner that
/// is not finite are left out.
[[nodiscard]] Triangles world_triangles(const DiffuseScene& scene, const Vec3d& origin = Vec3d(0));

}  // namespace rnmbake
