// scene/surface.h - the triangles of one target, in world space, ready to become receivers.
#pragma once

#include "base/math.h"
#include "scene/mesh.h"
#include "scene/tangents.h"

#include <array>
#include <cstdint>
#include <vector>

namespace rnmbake {

struct SurfaceCorner {
  Vec3 position;             // world space, lifted off the surface along the face normal
  Frame frame;               // world space
  Vec2 uv;                   // lightmap UV, v up
  std::uint32_t vertex = 0;  // of the mesh
};

/// One triangle; its corners run anti-clockwise seen from where `normal` points.
struct SurfaceTriangle {
  std::array<SurfaceCorner, 3> corners;
  Vec3 normal;               // geometric, world space, unit; on the side that Cycles calls the front
  float height = 0;          // of the corners over the surface
  std::uint32_t source = 0;  // number of the mesh's triangle
};

struct Surface {
  std::vector<SurfaceTriangle> triangles;
  std::size_t degenerate = 0;  // triangles left out because they have no area in the world
};

/// Light whose direction rises over a face by no more than this (sine) runs in its plane: directions and
/// normals are rounded to about a tenth of it. It does not reach the face.
inline constexpr float grazing_sine = 1e-6F;

/// `subset`: triangle numbers of `mesh`. `uv` and `frames` as in scene/tangents.h.
[[nodiscard]] Surface make_surface(const Mesh& mesh, const std::vector<std::uint32_t>& subset,
                                   const std::vector<Vec2>& uv, const TangentFrames& frames,
                                   const Mat44& to_world);

/// The largest height of a triangle, in texels as wide as they are on average; 0 where it has no UVs. `map`:
/// texels of the lightmap along u and v.
[[nodiscard]] double height_in_texels(const Surface& surface, const Vec2& map);

}  // namespace rnmbake
