// tests/ssbump/low_high.h - low-poly squares and detail to put on them.
#pragma once

#include "scene/tangents.h"
#include "ssbump/mesh/mesh_occlusion.h"

#include <array>
#include <string>
#include <vector>

namespace rnmbake {

/// A rectangle in the plane z = 0 facing +z, with its corners anti-clockwise from `low`; UVs go from `uv_low`
/// to `uv_high` along x and y.
inline LowSurface low_rectangle(const std::string& name, const Vec2& low, const Vec2& high,
                                const Vec2& uv_low = {0, 0}, const Vec2& uv_high = {1, 1}) {
  const Frame frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1};
  const auto corner = [&](int x, int y) {
    return SurfaceCorner{{x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, 0},
                         frame,
                         {x != 0 ? uv_high.x : uv_low.x, y != 0 ? uv_high.y : uv_low.y}};
  };
  LowSurface low_surface{name, {}};
  low_surface.surface.triangles.push_back({{corner(0, 0), corner(1, 0), corner(1, 1)}, {0, 0, 1}, 0});
  low_surface.surface.triangles.push_back({{corner(0, 0), corner(1, 1), corner(0, 1)}, {0, 0, 1}, 1});
  return low_surface;
}

/// Adds a flat quad; anti-clockwise seen from its front.
inline void add_quad(HighMesh& mesh, const std::array<Vec3, 4>& corners) {
  const Vec3 normal = unit((corners[1] - corners[0]).cross(corners[2] - corners[0]));
  for (const std::size_t k : {0, 1, 2, 0, 2, 3}) {
    mesh.position.push_back(corners[k]);
    mesh.normal.push_back(normal);
  }
}

/// A horizontal square around the origin, facing up.
inline HighMesh floor_at(float z, float half_side = 1e4F) {
  HighMesh mesh;
  const float s = half_side;
  add_quad(mesh, {Vec3(-s, -s, z), {s, -s, z}, {s, s, z}, {-s, s, z}});
  return mesh;
}

}  // namespace rnmbake
