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
  Vec3 position;  // world space, lifted off the surface along the face normal
  Frame frame;    // world space
  Vec2 uv;        // lightmap UV, v up
};

/// One triangle; its corners run anti-clockwise seen from where `normal` points.
struct SurfaceTriangle {
  std::array<SurfaceCorner, 3> corners;
  Vec3 normal;               // geometric, world space, unit; on the side that Cycles calls the front
  std::uint32_t source = 0;  // number of the mesh's triangle
};

struct Surface {
  std::vector<SurfaceTriangle> triangles;
  std::size_t degenerate = 0;  // triangles left out because they have no area in the world
};

/// How far a receiver stands off its surface: enough that rays do not start below it at any distance from
/// the origin (1e-6 of it, some 10 times the spacing of floats there; 2e-7 was still clean from 126 units
/// on), yet small beside a small object (1/1000 of `diagonal`). World units.
[[nodiscard]] double lift(const Vec3& position, double diagonal);

/// `subset`: triangle numbers of `mesh`. `uv` and `frames` as in scene/tangents.h.
[[nodiscard]] Surface make_surface(const Mesh& mesh, const std::vector<std::uint32_t>& subset,
                                   const std::vector<Vec2>& uv, const TangentFrames& frames,
                                   const Mat44& to_world);

}  // namespace rnmbake
