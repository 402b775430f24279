#include "scene/surface.h"

#include <algorithm>
#include <utility>

namespace rnmbake {
namespace {

Vec3d to_world_point(const Vec3& p, const Mat44& matrix) {
  return Vec3d(p) * matrix;
}

double diagonal_of(const Mesh& mesh, const Mat44& matrix) {
  if (mesh.positions.empty()) return 0;
  Vec3d low = to_world_point(mesh.positions.front(), matrix), high = low;
  for (const Vec3& position : mesh.positions) {
    const Vec3d p = to_world_point(position, matrix);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  return (high - low).length();
}

/// Draws the corners in by `distance` from each edge, at most by a twelfth of the way to the middle: light
/// from just below a face must not slip past an open edge to a receiver that stands off it.
void shrink(SurfaceTriangle& triangle, double distance) {
  auto& k = triangle.corners;
  const Vec3 a = k[1].position - k[0].position, b = k[2].position - k[1].position,
             c = k[0].position - k[2].position;
  const double perimeter = double(a.length()) + b.length() + c.length();
  const double inradius = a.cross(b).length() / perimeter;
  const auto share = static_cast<float>(std::min(0.08, distance / inradius));  // also where it is NaN
  const Vec3 middle = (k[0].position + k[1].position + k[2].position) / 3.0F;
  for (SurfaceCorner& corner : k) corner.position += (middle - corner.position) * share;
}

}  // namespace

double lift(const Vec3& position, double diagonal) {
  const double near_origin = std::clamp(1e-3 * diagonal, 1e-6, 1e-5);
  return std::max(near_origin, 1e-6 * Vec3d(position).length());
}

Surface make_surface(const Mesh& mesh, const std::vector<std::uint32_t>& subset, const std::vector<Vec2>& uv,
                     const TangentFrames& frames, const Mat44& to_world) {
  const double diagonal = diagonal_of(mesh, to_world);
  const bool mirrored = to_world.determinant() < 0;
  Surface surface;
  surface.triangles.reserve(subset.size());
  for (const std::uint32_t index : subset) {
    std::array<Vec3d, 3> p;
    SurfaceTriangle triangle;
    triangle.source = index;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t corner = 3 * std::size_t(index) + k;
      p[k] = to_world_point(mesh.positions[mesh.corner_vertex(corner)], to_world);
      triangle.corners[k] = {Vec3(p[k]), frames.corners[corner], uv[mesh.triangle_loops[corner]]};
    }
    Vec3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
    if (mirrored) normal = -normal;  // a mirrored object keeps its outside, so its winding turns round
    const double length = normal.length();
    if (!(length > 0)) {
      ++surface.degenerate;
      continue;
    }
    triangle.normal = Vec3(normal / length);
    const double height = lift(triangle.corners[0].position, diagonal);
    for (SurfaceCorner& corner : triangle.corners)
      corner.position += triangle.normal * static_cast<float>(height);
    shrink(triangle, 40 * height);  // covers rays 3 degrees below the face, 5.x doubles the height
    if (mirrored) std::swap(triangle.corners[1], triangle.corners[2]);
    surface.triangles.push_back(triangle);
  }
  return surface;
}

}  // namespace rnmbake
