#include "scene/surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rnmbake {
namespace {

/// How far a receiver stands off its surface: twice what was needed in each Blender for no ray to meet the
/// surface that it starts over, at any place, size and angle.
constexpr double roundings = 8;

/// What 32-bit arithmetic may make of a triangle's plane: Cycles brings either the mesh to the world or,
/// where a mesh has several users, rays to the mesh. Only coordinates that lie across the plane count.
class Rounding {
 public:
  explicit Rounding(const Mat44& to_world) : to_world_(to_world), from_world_(to_world.inverse()) {}

  /// World units. `local`: the corners in the object's space; `normal`: in the world, unit.
  [[nodiscard]] double across(const std::array<Vec3d, 3>& local, const Vec3d& normal) const {
    const Vec3d across_local = (local[1] - local[0]).cross(local[2] - local[0]);
    Vec3d plane, terms;  // across_local seen from the world, and the sizes of the terms of its sums
    for (int a = 0; a < 3; ++a) {
      plane[a] = terms[a] = 0;
      for (int b = 0; b < 3; ++b) {
        plane[a] += across_local[b] * from_world_[a][b];
        terms[a] += std::abs(across_local[b] * from_world_[a][b]);
      }
    }
    const double length = plane.length();
    double sum = extent(local);
    for (int a = 0; a < 3; ++a) {
      const double share = length > 0 ? terms[a] / length : 0;
      sum += std::max(share, std::abs(normal[a])) * farthest(local, a);
    }
    return sum * 0x1p-24;
  }

 private:
  /// The largest sum of sizes that a corner's world coordinate is made of.
  [[nodiscard]] double farthest(const std::array<Vec3d, 3>& local, int axis) const {
    double most = 0;
    for (const Vec3d& p : local) {
      double sum = std::abs(to_world_[3][axis]);
      for (int b = 0; b < 3; ++b) sum += std::abs(p[b] * to_world_[b][axis]);
      most = std::max(most, sum);
    }
    return most;
  }
  /// Of the triangle in the world.
  [[nodiscard]] double extent(const std::array<Vec3d, 3>& local) const {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3d edge;
      to_world_.multDirMatrix(local[(k + 1) % 3] - local[k], edge);
      longest = std::max(longest, edge.length());
    }
    return longest;
  }

  Mat44 to_world_, from_world_;
};

}  // namespace

Surface make_surface(const Mesh& mesh, const std::vector<std::uint32_t>& subset, const std::vector<Vec2>& uv,
                     const TangentFrames& frames, const Mat44& to_world) {
  const Rounding rounding(to_world);
  const bool mirrored = to_world.determinant() < 0;
  Surface surface;
  surface.triangles.reserve(subset.size());
  for (const std::uint32_t index : subset) {
    std::array<Vec3d, 3> local, p;
    SurfaceTriangle triangle;
    triangle.source = index;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t corner = 3 * std::size_t(index) + k;
      const std::uint32_t vertex = mesh.corner_vertex(corner);
      local[k] = Vec3d(mesh.positions[vertex]);
      p[k] = local[k] * to_world;
      triangle.corners[k] = {Vec3(0), frames.corners[corner], uv[mesh.triangle_loops[corner]], vertex};
    }
    Vec3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
    if (mirrored) normal = -normal;  // a mirrored object keeps its outside, so its winding turns round
    const double length = normal.length();
    if (!(length > 0)) {
      ++surface.degenerate;
      continue;
    }
    normal /= length;
    triangle.normal = Vec3(normal);
    const double height = roundings * rounding.across(local, normal);
    triangle.height = static_cast<float>(height);
    for (std::size_t k = 0; k < 3; ++k) triangle.corners[k].position = Vec3(p[k] + normal * height);
    if (mirrored) std::swap(triangle.corners[1], triangle.corners[2]);
    surface.triangles.push_back(triangle);
  }
  return surface;
}

double height_in_texels(const Surface& surface, const Vec2& map) {
  double area = 0, texels = 0, height = 0;
  for (const SurfaceTriangle& triangle : surface.triangles) {
    const auto& k = triangle.corners;
    const Vec2 u = (k[1].uv - k[0].uv) * map, v = (k[2].uv - k[0].uv) * map;
    texels += std::abs(double(u.x) * v.y - double(u.y) * v.x);
    area += Vec3d(k[1].position - k[0].position).cross(Vec3d(k[2].position - k[0].position)).length();
    height = std::max(height, double(triangle.height));
  }
  return texels > 0 && area > 0 ? height * std::sqrt(texels / area) : 0;
}

}  // namespace rnmbake
