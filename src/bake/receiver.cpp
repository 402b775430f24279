#include "bake/receiver.h"

#include "bake/clip.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rnmbake {
namespace {

using Horizon = ObjectSettings::Horizon;

/// Normals of a receiver, tangents of the face among them: at most 89.95 degrees off it. Blender keeps corner
/// normals to about 0.006 degrees.
const float lowest_sine = std::sin(0.05F * float(pi) / 180.0F);

using CornerNormals = std::array<Vec3, 3>;

/// Blender's custom normals are unit vectors, so a new corner within a triangle bends the interpolation.
/// Parts of no more than 10 degrees keep that below a tenth of a degree; no part has to be smaller than half
/// a texel, which averages over it.
int parts_for(const CornerNormals& normals, int most) {
  const float closest =
      std::min({normals[0].dot(normals[1]), normals[1].dot(normals[2]), normals[2].dot(normals[0])});
  const double degrees = std::acos(std::clamp(double(closest), -1.0, 1.0)) * 180 / pi;
  return std::clamp(static_cast<int>(std::ceil(degrees / 10)), 1, most);
}

/// Half texels along the longest edge of the triangle, 16 at most.
int half_texels(const SurfaceTriangle& triangle, const Vec2& map) {
  float longest2 = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 edge = (triangle.corners[(k + 1) % 3].uv - triangle.corners[k].uv) * map;
    longest2 = std::max(longest2, edge.length2());
  }
  return static_cast<int>(std::clamp(std::ceil(2 * std::sqrt(longest2)), 1.0F, 16.0F));
}

/// Appends triangles whose positions, UVs and normals interpolate as those of `triangle` do; `finish` makes
/// the interpolated normal legal for a receiver.
template <typename Finish>
void append(std::vector<ReceiverCorner>& out, const std::vector<Weights>& weights,
            const SurfaceTriangle& triangle, const CornerNormals& normals, Finish finish) {
  const auto& k = triangle.corners;
  for (const Weights& w : weights) {
    out.push_back({k[0].position * w.x + k[1].position * w.y + k[2].position * w.z,
                   finish(normals[0] * w.x + normals[1] * w.y + normals[2] * w.z),
                   k[0].uv * w.x + k[1].uv * w.y + k[2].uv * w.z});
  }
}

/// The part of the triangle inside the unit square of the lightmap: the rest would land on a neighbour's
/// tile.
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

/// Cuts one target into receiver passes, triangle by triangle.
class PassMaker {
 public:
  PassMaker(const std::vector<BasisDirection>& bases, Horizon horizon, const Vec2& map)
      : bases_(bases),
        horizon_(horizon),
        map_(map),
        above_(bases.size()),
        below_(bases.size()),
        moments_(5) {}

  /// Room for as many triangles as most targets need: those that lie above their face and inside the map.
  void reserve(std::size_t triangles) {
    for (auto& corners : above_) corners.reserve(3 * triangles);
  }

  void add(const SurfaceTriangle& triangle) {
    const WeightPolygon polygon = inside_map(triangle);
    const std::vector<Weights> whole = triangulate(polygon);
    bool any_below = false;
    for (std::size_t b = 0; b < bases_.size(); ++b) any_below |= add_basis(triangle, polygon, whole, b);
    ++counts_.triangles;
    if (!any_below) return;
    ++counts_.triangles_below;
    if (horizon_ == Horizon::identity) add_moments(triangle, whole);
  }

  ReceiverPasses finish() {
    ReceiverPasses result;
    for (std::size_t b = 0; b < bases_.size(); ++b) {
      result.passes.push_back({ReceiverPass::Role::basis, b, std::move(above_[b])});
    }
    for (std::size_t b = 0; b < bases_.size(); ++b) {
      if (!below_[b].empty()) result.passes.push_back({ReceiverPass::Role::below, b, std::move(below_[b])});
    }
    for (std::size_t m = 0; m < moments_.size(); ++m) {
      if (!moments_[m].empty())
        result.passes.push_back({ReceiverPass::Role::moment, m, std::move(moments_[m])});
    }
    result.counts = counts_;
    return result;
  }

 private:
  /// `whole`: the triangles of `polygon`. Returns whether a corner of this basis lies under the face.
  bool add_basis(const SurfaceTriangle& triangle, const WeightPolygon& polygon,
                 const std::vector<Weights>& whole, std::size_t b) {
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
      append(above_[b], whole, triangle, up, [](const Vec3& n) { return n.normalized(); });
    } else {
      const int parts = parts_for(up, half_texels(triangle, map_));
      append(above_[b], triangulate(clip(polygon, height), parts), triangle, up, legal);
      append(below_[b], triangulate(clip(polygon, depth), parts), triangle, down, legal);
    }
    return under > 0;
  }

  void add_moments(const SurfaceTriangle& triangle, const std::vector<Weights>& whole) {
    const FaceAxes axes = face_axes(triangle.normal);
    const std::array<Vec3, 5> directions{axes.t1, -axes.t1, axes.t2, -axes.t2, triangle.normal};
    for (std::size_t m = 0; m < directions.size(); ++m) {
      const Vec3 n = raise_above(directions[m], triangle.normal, lowest_sine);
      append(moments_[m], whole, triangle, {n, n, n}, [&n](const Vec3&) { return n; });
    }
  }

  const std::vector<BasisDirection>& bases_;
  Horizon horizon_;
  Vec2 map_;
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
  return frame.to_world(basis).normalized();
}

Vec3 raise_above(const Vec3& n, const Vec3& face_normal, float sine) {
  const Vec3 unit = n.normalized();
  const float height = unit.dot(face_normal);
  if (height >= sine) return unit;
  Vec3 along = unit - face_normal * height;
  if (along.length2() < 1e-12F) along = face_axes(face_normal).t1;
  return along.normalized() * std::sqrt(1 - sine * sine) + face_normal * sine;
}

ReceiverPasses make_receiver_passes(const Surface& surface, const std::vector<BasisDirection>& bases,
                                    ObjectSettings::Horizon horizon, const Vec2& map) {
  PassMaker maker(bases, horizon, map);
  maker.reserve(surface.triangles.size());
  for (const SurfaceTriangle& triangle : surface.triangles) maker.add(triangle);
  return maker.finish();
}

}  // namespace rnmbake
