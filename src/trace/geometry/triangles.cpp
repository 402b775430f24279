#include "trace/geometry/triangles.h"

#include <algorithm>
#include <cmath>

#include <ImathBox.h>

namespace rnmbake {
namespace {

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Appends the triangles of an object. Two corners are swapped where it is mirrored, so that its front stays.
void add_object(const DiffuseScene& scene, std::size_t object_index, const Vec3d& origin, Triangles& out) {
  const SceneObject& object = scene.survey.objects[object_index];
  const Mesh& mesh = scene.survey.mesh_of(object);
  const Mat44 for_normals = object.to_world.inverse().transposed();
  const bool mirrored = object.to_world.determinant() < 0;
  const auto& materials = scene.object_materials[object_index];

  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const std::uint32_t slot = mesh.polygon_slot[mesh.triangle_polygon[t]];
    const int material = materials[std::min<std::size_t>(slot, materials.size() - 1)];
    const int uvs = scene.materials[material].picture_uv;
    Vec3 p[3], n[3];
    Vec2 uv[3];
    for (int k = 0; k < 3; ++k) {
      const std::size_t corner = 3 * t + (mirrored && k > 0 ? 3 - k : k);  // as in a Surface
      const std::uint32_t loop = mesh.triangle_loops[corner];
      p[k] = Vec3(Vec3d(mesh.positions[mesh.loop_vertex[loop]]) * object.to_world - origin);
      Vec3d normal;
      for_normals.multDirMatrix(Vec3d(mesh.loop_normal[loop]), normal);
      n[k] = Vec3(normal.normalized());
      uv[k] = uvs < 0 ? Vec2(0, 0) : scene.picture_uvs[uvs][loop];
    }
    const Vec3d face = Vec3d(p[1] - p[0]).cross(Vec3d(p[2] - p[0]));
    const double length = face.length();
    if (!finite(p[0]) || !finite(p[1]) || !finite(p[2]) || !(length > 0) || !std::isfinite(length)) continue;
    for (int k = 0; k < 3; ++k) {
      out.position.push_back(p[k]);
      out.normal.push_back(finite(n[k]) && n[k].length2() > 0 ? n[k] : Vec3(face / length));
      out.uv.push_back(uv[k]);
    }
    out.material.push_back(static_cast<std::uint32_t>(material));
    out.object.push_back(static_cast<std::uint32_t>(object_index));
    out.source.push_back(static_cast<std::uint32_t>(t));
  }
}

}  // namespace

Vec3d middle_of(const DiffuseScene& scene) {
  Imath::Box3d box;
  for (std::size_t i = 0; i < scene.survey.objects.size(); ++i) {
    if (!scene.takes_part(i)) continue;
    const SceneObject& object = scene.survey.objects[i];
    for (const Vec3& p : scene.survey.mesh_of(object).positions) {
      if (finite(p)) box.extendBy(Vec3d(p) * object.to_world);
    }
  }
  return box.isEmpty() ? Vec3d(0) : box.center();
}

Triangles world_triangles(const DiffuseScene& scene, const Vec3d& origin) {
  Triangles triangles;
  for (std::size_t i = 0; i < scene.survey.objects.size(); ++i) {
    if (scene.takes_part(i)) add_object(scene, i, origin, triangles);
  }
  return triangles;
}

}  // namespace rnmbake
