// tests/scene/test_meshes.h - small meshes with known frames and UVs, and how objects place them.
#pragma once

#include "scene/surface.h"

#include <cstdint>
#include <vector>

namespace rnmbake {

/// A mesh of triangles: every three entries of `corners` are one, and each corner is a loop.
inline Mesh triangle_mesh(const std::vector<Vec3>& positions, const std::vector<std::uint32_t>& corners,
                          const std::vector<Vec3>& corner_normals) {
  Mesh mesh;
  mesh.name = "test";
  mesh.positions = positions;
  mesh.loop_vertex = corners;
  mesh.loop_normal = corner_normals;
  for (std::uint32_t loop = 0; loop < corners.size(); ++loop) {
    mesh.triangle_loops.push_back(loop);
    if (loop % 3 == 0) {
      mesh.triangle_polygon.push_back(loop / 3);
      mesh.polygon_start.push_back(loop);
      mesh.polygon_size.push_back(3);
      mesh.polygon_slot.push_back(0);
    }
  }
  return mesh;
}

/// The square [-1,1]^2 at z = 0, facing +z: two triangles.
inline Mesh square() {
  return triangle_mesh({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {0, 1, 2, 0, 2, 3},
                       std::vector<Vec3>(6, Vec3(0, 0, 1)));
}

/// The square's own UVs: the whole picture.
inline std::vector<Vec2> square_uv() {
  return {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
}

/// The square as an object's matrix stands it up or moves it.
inline Surface square_surface(const Mat44& to_world = Mat44()) {
  const Mesh mesh = square();
  return make_surface(mesh, {0, 1}, square_uv(), tangent_frames(mesh, square_uv(), to_world), to_world);
}

inline Mat44 scaled(double x, double y, double z) {
  Mat44 matrix;
  matrix.setScale(Vec3d(x, y, z));
  return matrix;
}

}  // namespace rnmbake
