#include "scene/tangents.h"

#include "scene/tangent_groups.h"
#include "scene/weld.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rnmbake {
namespace {

using Linear = Imath::M33d;

/// Directions go by the upper 3x3 alone, so that an object far from the origin keeps its precision.
Linear linear_part(const Mat44& m) {
  return {m[0][0], m[0][1], m[0][2], m[1][0], m[1][1], m[1][2], m[2][0], m[2][1], m[2][2]};
}

/// The inverse transpose times the determinant: the normal's transform, which a flattened object has too.
/// The sign of a mirrored map is taken out, so that normals stay on their side of the surface.
Linear normal_part(const Linear& m, double determinant) {
  const Vec3d x(m[0][0], m[0][1], m[0][2]), y(m[1][0], m[1][1], m[1][2]), z(m[2][0], m[2][1], m[2][2]);
  const double side = determinant < 0 ? -1 : 1;
  const Vec3d yz = y.cross(z) * side, zx = z.cross(x) * side, xy = x.cross(y) * side;
  return {yz.x, yz.y, yz.z, zx.x, zx.y, zx.z, xy.x, xy.y, xy.z};
}

Vec3d unit_or_zero(const Vec3d& v) {
  const double length = v.length();
  return length > 0 ? v / length : Vec3d(0);
}

Vec3d in_plane(const Vec3d& v, const Vec3d& normal) {
  return unit_or_zero(v - normal * v.dot(normal));
}

Vec3d any_perpendicular(const Vec3d& n) {
  return in_plane(std::abs(n.x) < 0.9 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0), n);
}

/// The direction in which u grows over a triangle while v stays the same, and what the grouping must know of
/// it.
struct Gradient {
  Vec3d tangent{0, 0, 0};
  TriangleUv uv;
};

struct Source {
  const Mesh& mesh;
  const std::vector<Vec2>& uv;
  Linear to_world;

  [[nodiscard]] const Vec3& local(std::size_t corner) const {
    return mesh.positions[mesh.corner_vertex(corner)];
  }
  /// From one corner to another, in world space.
  [[nodiscard]] Vec3d edge(std::size_t from, std::size_t to) const {
    return (Vec3d(local(to)) - Vec3d(local(from))) * to_world;
  }
  [[nodiscard]] Vec2 corner_uv(std::size_t corner) const { return uv[mesh.triangle_loops[corner]]; }
};

Gradient gradient_of(const Source& source, std::size_t triangle) {
  const std::size_t a = 3 * triangle, b = a + 1, c = a + 2;
  const Vec2 origin = source.corner_uv(a);
  const double u1 = double{source.corner_uv(b).x} - origin.x, v1 = double{source.corner_uv(b).y} - origin.y;
  const double u2 = double{source.corner_uv(c).x} - origin.x, v2 = double{source.corner_uv(c).y} - origin.y;
  const double area = u1 * v2 - u2 * v1;
  Gradient gradient;
  gradient.uv.flat = source.local(a) == source.local(b) || source.local(b) == source.local(c) ||
                     source.local(c) == source.local(a);
  gradient.uv.preserving = area > 0;
  const Vec3d ab = source.edge(a, b), ac = source.edge(a, c);
  gradient.tangent = unit_or_zero((ab * v2 - ac * v1) * (area > 0 ? 1.0 : -1.0));
  gradient.uv.any = area == 0 || gradient.tangent.length2() == 0;
  return gradient;
}

/// The angle of the triangle at a corner, seen along the corner's normal.
double corner_angle(const Source& source, std::size_t corner, const Vec3d& normal) {
  const std::size_t first = corner - corner % 3;
  const Vec3d before = in_plane(source.edge(corner, first + (corner + 2 - first) % 3), normal);
  const Vec3d after = in_plane(source.edge(corner, first + (corner + 1 - first) % 3), normal);
  return std::acos(std::clamp(before.dot(after), -1.0, 1.0));
}

std::vector<std::uint32_t> weld_corners(const Source& source, std::size_t corners) {
  return weld<8>(corners, [&](std::size_t corner) {
    const Vec3 &p = source.local(corner), &n = source.mesh.loop_normal[source.mesh.triangle_loops[corner]];
    const Vec2 uv = source.corner_uv(corner);
    return std::array{weld_bits(p.x), weld_bits(p.y), weld_bits(p.z),  weld_bits(n.x),
                      weld_bits(n.y), weld_bits(n.z), weld_bits(uv.x), weld_bits(uv.y)};
  });
}

std::vector<Vec3d> world_normals(const Mesh& mesh, const Linear& transform) {
  std::vector<Vec3d> normals(3 * mesh.triangles());
  for (std::size_t corner = 0; corner < normals.size(); ++corner) {
    const Vec3d normal = unit_or_zero(Vec3d(mesh.loop_normal[mesh.triangle_loops[corner]]) * transform);
    normals[corner] = normal.length2() > 0 ? normal : Vec3d(0, 0, 1);
  }
  return normals;
}

/// A tangent before it is made perpendicular to its own corner's normal; zero: none.
struct Raw {
  Vec3d tangent{0, 0, 0};
  bool preserving = true;
};

std::vector<Vec3d> group_sums(const Source& source, const std::vector<Gradient>& gradients,
                              const std::vector<TriangleUv>& triangles,
                              const std::vector<std::uint32_t>& groups, const std::vector<Vec3d>& normals) {
  std::vector<Vec3d> sums(groups.size(), Vec3d(0));
  for (std::size_t corner = 0; corner < groups.size(); ++corner) {
    if (groups[corner] != no_group && !triangles[corner / 3].any) {
      const Vec3d direction = in_plane(gradients[corner / 3].tangent, normals[corner]);
      sums[groups[corner]] += direction * corner_angle(source, corner, normals[corner]);
    }
  }
  return sums;
}

/// Corners of triangles without area take what the first good corner at the same vertex has.
void lend_to_flat(const std::vector<std::uint32_t>& vertex, const std::vector<TriangleUv>& triangles,
                  std::vector<Raw>& raw) {
  std::vector<std::uint32_t> lender(vertex.size(), no_group);
  for (std::uint32_t corner = 0; corner < vertex.size(); ++corner) {
    if (!triangles[corner / 3].flat && lender[vertex[corner]] == no_group) {
      lender[vertex[corner]] = corner;
    }
  }
  for (std::size_t corner = 0; corner < vertex.size(); ++corner) {
    if (triangles[corner / 3].flat && lender[vertex[corner]] != no_group) {
      raw[corner] = raw[lender[vertex[corner]]];
    }
  }
}

std::vector<Raw> raw_tangents(const Source& source, const std::vector<Vec3d>& normals) {
  std::vector<Gradient> gradients(source.mesh.triangles());
  std::vector<TriangleUv> triangles(gradients.size());
  for (std::size_t i = 0; i < gradients.size(); ++i) {
    gradients[i] = gradient_of(source, i);
    triangles[i] = gradients[i].uv;
  }
  const std::vector<std::uint32_t> vertex = weld_corners(source, normals.size());
  const std::vector<std::uint32_t> groups = tangent_groups(vertex, triangles);
  const std::vector<Vec3d> sums = group_sums(source, gradients, triangles, groups, normals);
  std::vector<Raw> raw(normals.size());
  for (std::size_t corner = 0; corner < raw.size(); ++corner) {
    raw[corner].preserving = triangles[corner / 3].preserving;
    raw[corner].tangent = groups[corner] == no_group ? Vec3d(0) : sums[groups[corner]];
  }
  lend_to_flat(vertex, triangles, raw);
  return raw;
}

}  // namespace

TangentFrames tangent_frames(const Mesh& mesh, const std::vector<Vec2>& uv, const Mat44& to_world) {
  const Source source{mesh, uv, linear_part(to_world)};
  const double determinant = source.to_world.determinant();
  const std::vector<Vec3d> normals = world_normals(mesh, normal_part(source.to_world, determinant));
  const std::vector<Raw> raw = raw_tangents(source, normals);
  TangentFrames frames;
  frames.corners.resize(raw.size());
  for (std::size_t corner = 0; corner < raw.size(); ++corner) {
    Vec3d tangent = in_plane(raw[corner].tangent, normals[corner]);
    if (tangent.length2() == 0) {
      tangent = any_perpendicular(normals[corner]);
      ++frames.degenerate_corners;
    }
    // A mirroring turns cross products around, but not the directions in which u and v grow.
    const double sign = raw[corner].preserving == (determinant >= 0) ? 1 : -1;
    const Vec3d bitangent = normals[corner].cross(tangent) * sign;
    frames.corners[corner] = {Vec3(tangent), Vec3(bitangent), Vec3(normals[corner]),
                              static_cast<float>(sign)};
  }
  return frames;
}

}  // namespace rnmbake
