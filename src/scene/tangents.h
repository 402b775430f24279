// scene/tangents.h - per-corner tangent frames in world space, as MikkTSpace defines them.
#pragma once

#include "base/math.h"
#include "scene/mesh.h"

#include <vector>

namespace rnmbake {

/// A right-handed (unless mirrored) orthonormal frame: x = tangent (direction of growing u), y = bitangent
/// (growing v), z = normal. `sign` is -1 where the UVs are mirrored: bitangent = sign * cross(normal,
/// tangent).
struct Frame {
  Vec3 tangent, bitangent, normal;
  float sign = 1;

  [[nodiscard]] Vec3 to_world(const Vec3& v) const { return tangent * v.x + bitangent * v.y + normal * v.z; }
  [[nodiscard]] Vec3 to_tangent(const Vec3& v) const {
    return {v.dot(tangent), v.dot(bitangent), v.dot(normal)};
  }
};

struct TangentFrames {
  std::vector<Frame> corners;          // [3 x triangles], world space
  std::size_t degenerate_corners = 0;  // no usable UV gradient: an arbitrary tangent was taken
};

/// Frames of every triangle corner of `mesh` placed by `to_world` (any affine map, mirrored ones too).
/// Normals go by the inverse transpose; tangents follow "Simulation of Wrinkled Surfaces Revisited"
/// (Mikkelsen 2008): per-triangle dP/du of the world-space mesh, projected into the plane of the
/// corner's normal, averaged by corner angle over corners that share position, normal, UV and orientation.
/// `uv` has one entry for each loop of the mesh.
[[nodiscard]] TangentFrames tangent_frames(const Mesh& mesh, const std::vector<Vec2>& uv,
                                           const Mat44& to_world);

}  // namespace rnmbake
