#include "bake/receiver.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/clip.h"

namespace rnmbake {
namespace {

const float lowest_sine = std::sin(float(pi) / 180.0F);       // normals of a receiver: at most 89 degrees off
const float moment_sine = std::sin(0.1F * float(pi) / 180.0F); // tangents of the face: 89.9 degrees off

using CornerNormals = std::array<Vec3, 3>;

/// Appends a polygon as a fan. Positions, UVs and normals interpolate as the triangle's do; interpolated
/// normals stay unnormalised until `finish` makes them legal for the receiver.
template <typename Finish>
void append(std::vector<ReceiverCorner>& out, const WeightPolygon& polygon, const SurfaceTriangle& triangle,
            const CornerNormals& normals, Finish finish) {
  const auto corner = [&](const Weights& w) {
    ReceiverCorner c;
    const auto& k = triangle.corners;
    c.position = k[0].position * w.x + k[1].position * w.y + k[2].position * w.z;
    c.uv = k[0].uv * w.x + k[1].uv * w.y + k[2].uv * w.z;
    c.normal = finish(normals[0] * w.x + normals[1] * w.y + normals[2] * w.z);
    return c;
  };
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    out.insert(out.end(), {corner(polygon[0]), corner(polygon[i - 1]), corner(polygon[i])});
  }
}

/// The part of the triangle inside the unit square of the lightmap: the rest would land on a neighbour's tile.
WeightPolygon inside_map(const SurfaceTriangle& triangle) {
  const auto& k = triangle.corners;
  WeightPolygon polygon = whole_triangle();
  for (int axis = 0; axis < 2; ++axis) {
    const std::array<float, 3> low{k[0].uv[axis], k[1].uv[axis], k[2].uv[axis]};
    const std::array<float, 3> high{1 - low[0], 1 - low[1], 1 - low[2]};
    if (*std::min_element(low.begin(), low.end()) < 0) polygon = clip(polygon, low);
    if (*std::min_element(high.begin(), high.end()) < 0) polygon = clip(polygon, high);
  }
  return polygon;
}

/// Cuts one target into sheets, triangle by triangle.
class SheetMaker {
 public:
  SheetMaker(const BasisSet& bases, Horizon horizon)
      : bases_(bases), horizon_(horizon), above_(bases.size()), below_(bases.size()), moments_(5) {}

  void add(const SurfaceTriangle& triangle) {
    const WeightPolygon polygon = inside_map(triangle);
    bool any_below = false;
    for (std::size_t b = 0; b < bases_.size(); ++b) any_below |= add_basis(triangle, polygon, b);
    ++counts_.triangles;
    if (!any_below) return;
    ++counts_.triangles_below;
    if (horizon_ == Horizon::identity) add_moments(triangle, polygon);
  }

  Sheets finish() {
    Sheets result;
    for (std::size_t b = 0; b < bases_.size(); ++b) {
      result.sheets.push_back({Sheet::Role::basis, b, std::move(above_[b])});
    }
    for (std::size_t b = 0; b < bases_.size(); ++b) {
      if (!below_[b].empty()) result.sheets.push_back({Sheet::Role::below, b, std::move(below_[b])});
    }
    for (std::size_t m = 0; m < moments_.size(); ++m) {
      if (!moments_[m].empty()) result.sheets.push_back({Sheet::Role::moment, m, std::move(moments_[m])});
    }
    result.counts = counts_;
    return result;
  }

 private:
  /// Returns whether a corner of this basis lies under the face.
  bool add_basis(const SurfaceTriangle& triangle, const WeightPolygon& polygon, std::size_t b) {
    CornerNormals up, down;
    std::array<float, 3> height{}, depth{};
    std::size_t under = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      up[k] = basis_normal(triangle.corners[k].frame, bases_[b].direction);
      down[k] = -up[k];
      height[k] = up[k].dot(triangle.normal);
      depth[k] = -height[k];
      under += height[k] < 0 ? 1 : 0;
    }
    counts_.corners += 3;
    counts_.corners_below += under;
    const auto legal = [&](const Vec3& n) { return raise_above(n, triangle.normal, lowest_sine); };
    if (under == 0 || horizon_ == Horizon::clamp) {
      for (Vec3& n : up) n = legal(n);
      append(above_[b], polygon, triangle, up, [](const Vec3& n) { return n.normalized(); });
    } else {
      append(above_[b], clip(polygon, height), triangle, up, legal);
      append(below_[b], clip(polygon, depth), triangle, down, legal);
    }
    return under > 0;
  }

  void add_moments(const SurfaceTriangle& triangle, const WeightPolygon& polygon) {
    const FaceAxes axes = face_axes(triangle.normal);
    const std::array<Vec3, 5> directions{axes.t1, -axes.t1, axes.t2, -axes.t2, triangle.normal};
    for (std::size_t m = 0; m < directions.size(); ++m) {
      const Vec3 n = raise_above(directions[m], triangle.normal, moment_sine);
      append(moments_[m], polygon, triangle, {n, n, n}, [&n](const Vec3&) { return n; });
    }
  }

  const BasisSet& bases_;
  Horizon horizon_;
  std::vector<std::vector<ReceiverCorner>> above_, below_, moments_;
  HorizonCounts counts_;
};

}  // namespace

FaceAxes face_axes(const Vec3& normal) {
  const Vec3 helper = std::abs(normal.z) < 0.9F ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
  const Vec3 t1 = helper.cross(normal).normalized();
  return {t1, normal.cross(t1)};
}

Vec3 basis_normal(const Frame& frame, const Vec3& basis) {
  return (frame.tangent * basis.x + frame.bitangent * basis.y + frame.normal * basis.z).normalized();
}

Vec3 raise_above(const Vec3& n, const Vec3& face_normal, float sine) {
  const Vec3 unit = n.normalized();
  const float height = unit.dot(face_normal);
  if (height >= sine) return unit;
  Vec3 along = unit - face_normal * height;
  if (along.length2() < 1e-12F) along = face_axes(face_normal).t1;
  return along.normalized() * std::sqrt(1 - sine * sine) + face_normal * sine;
}

Sheets make_sheets(const Surface& surface, const BasisSet& bases, Horizon horizon) {
  SheetMaker maker(bases, horizon);
  for (const SurfaceTriangle& triangle : surface.triangles) maker.add(triangle);
  return maker.finish();
}

}  // namespace rnmbake
