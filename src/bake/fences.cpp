#include "bake/fences.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace rnmbake {
namespace {

constexpr double shown_share = 0.01;      // of a texel: narrower bands of light are not worth a fence
constexpr double steepest_of_all = 0.25;  // sine: beyond, a fence would shade as much as it shuts out
constexpr double highest = 1;             // texels that a fence may shade
constexpr double least_way = 1e-4;        // cosine between a light's direction and the way out over an edge

double size_of(const LightInfo& light, const char* name) {
  const auto found = light.sizes.find(name);
  return found == light.sizes.end() ? 0.0 : found->second;
}

Vec3d row(const Mat44& matrix, int r) {
  return {matrix[r][0], matrix[r][1], matrix[r][2]};
}

LightBall ball_of(const LightInfo& light) {
  if (light.type == "SUN") {
    return {true, row(light.to_world, 2).normalized(),
            std::sin(std::min(size_of(light, "angle") / 2, pi / 2))};
  }
  if (light.type != "AREA") return {false, row(light.to_world, 3), size_of(light, "shadow_soft_size")};
  const bool round = light.shape == "SQUARE" || light.shape == "DISK";
  const double size = size_of(light, "size"), other = round ? size : size_of(light, "size_y");
  const Vec3d u = row(light.to_world, 0) * (size / 2), v = row(light.to_world, 1) * (other / 2);
  return {false, row(light.to_world, 3), std::max((u + v).length(), (u - v).length())};
}

/// Greatest offset of a ray's start in Cycles, for rays along a surface: by 1e-5, and from 1 on by up to 256
/// float steps of each coordinate. World units along `normal`.
double start_offset(const Vec3& place, const Vec3& normal) {
  double sum = 0;
  for (int a = 0; a < 3; ++a) {
    sum += std::abs(double(normal[a])) * std::max(1e-5, 256 * 0x1p-23 * std::abs(double(place[a])));
  }
  return sum;
}

/// One edge of a triangle.
struct Rim {
  std::uint32_t low = 0, high = 0;  // vertices of the mesh, in order of their numbers
  bool forward = false;             // it runs from `low` to `high`
  const SurfaceTriangle* face = nullptr;
  std::size_t corner = 0;  // where it starts
  bool open = false;       // light comes in over it
  bool along = false;      // ... which runs along the face

  [[nodiscard]] auto edge() const { return std::tie(low, high); }
};

/// A triangle's plane, edges and size, for comparisons with lights.
class Face {
 public:
  Face(const SurfaceTriangle& triangle, const Vec2& map) : triangle_(triangle), normal_(triangle.normal) {
    const auto& k = triangle.corners;
    centre_ = Vec3d(k[0].position + k[1].position + k[2].position) / 3;
    for (const SurfaceCorner& corner : k)
      radius_ = std::max(radius_, (Vec3d(corner.position) - centre_).length());
    steepest_ = std::min(steepest_of_all, double(triangle.height) / (shown_share * texel(map)));
  }

  /// Whether some of the light's directions lie in the face's plane, or below it by less than `steepest_`
  /// (sine).
  [[nodiscard]] bool grazed_by(const LightBall& light) const { return between(light, steepest_); }
  /// Whether some of them are so nearly in the plane that Cycles' shadow rays may miss the triangle on which
  /// they start.
  [[nodiscard]] bool runs_along(const LightBall& light) const {
    return between(light, std::max(1e-5, double(triangle_.height) / radius_));
  }
  /// Whether some of the light comes in over the edge that starts at a corner.
  [[nodiscard]] bool comes_over(std::size_t corner, const LightBall& light) const {
    const Vec3d out = way_out(corner);
    if (light.far) return light.place.dot(out) + light.radius > least_way;
    const Vec3d way = light.place - Vec3d(triangle_.corners[corner].position);
    return way.dot(out) + light.radius > least_way * (way.length() + radius_);
  }
  /// World units.
  [[nodiscard]] double texel(const Vec2& map) const {
    const auto& k = triangle_.corners;
    const Vec2 u = (k[1].uv - k[0].uv) * map, v = (k[2].uv - k[0].uv) * map;
    const double texels = std::abs(double(u.x) * v.y - double(u.y) * v.x);
    const double area = (k[1].position - k[0].position).cross(k[2].position - k[0].position).length();
    return texels > 0 ? std::sqrt(area / texels) : std::numeric_limits<double>::infinity();
  }
  /// Direction of the edge that starts at a corner.
  [[nodiscard]] Vec3d along(std::size_t corner) const {
    const auto& k = triangle_.corners;
    return (Vec3d(k[(corner + 1) % 3].position) - Vec3d(k[corner].position)).normalized();
  }
  /// Direction over that edge, in the face's plane.
  [[nodiscard]] Vec3d way_out(std::size_t corner) const { return along(corner).cross(normal_).normalized(); }

 private:
  /// Whether some of the light's directions lie in the face's plane, or below it by a sine of `steepest` at
  /// most.
  [[nodiscard]] bool between(const LightBall& light, double steepest) const {
    const Vec3d way = light.far ? light.place : light.place - centre_;
    const double height = way.dot(normal_), range = light.far ? 1 : way.length() + radius_;
    return height - light.radius <= grazing_sine * range && height + light.radius > -steepest * range;
  }

  const SurfaceTriangle& triangle_;
  Vec3d normal_, centre_;
  double radius_ = 0, steepest_ = 0;
};

/// Rims of faces that some light grazes.
std::vector<Rim> rims_of(const Surface& surface, const std::vector<LightBall>& lights, const Vec2& map) {
  std::vector<Rim> rims;
  for (const SurfaceTriangle& triangle : surface.triangles) {
    const Face face(triangle, map);
    std::array<bool, 3> open{}, along{};
    bool grazed = false;
    for (const LightBall& light : lights) {
      if (!face.grazed_by(light)) continue;
      grazed = true;
      for (std::size_t k = 0; k < 3; ++k) {
        if (!face.comes_over(k, light)) continue;
        open[k] = true;
        along[k] = along[k] || face.runs_along(light);
      }
    }
    for (std::size_t k = 0; k < 3 && grazed; ++k) {
      const std::uint32_t from = triangle.corners[k].vertex, to = triangle.corners[(k + 1) % 3].vertex;
      rims.push_back({std::min(from, to), std::max(from, to), from < to, &triangle, k, open[k], along[k]});
    }
  }
  return rims;
}

/// Whether the face goes on over the edge in the same plane, so that the fence stands at its far end.
bool goes_on(const Rim& rim, const Rim& other) {
  const double bend = Vec3d(rim.face->normal).cross(Vec3d(other.face->normal)).length();
  return rim.forward != other.forward && bend <= grazing_sine && rim.face->normal.dot(other.face->normal) > 0;
}

double diagonal_of(const Surface& surface) {
  Vec3 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
  for (const SurfaceTriangle& triangle : surface.triangles) {
    for (const SurfaceCorner& corner : triangle.corners) {
      for (int a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], corner.position[a]);
        high[a] = std::max(high[a], corner.position[a]);
      }
    }
  }
  return surface.triangles.empty() ? 0 : (high - low).length();
}

/// Fence from a little under the face to a little over its receivers, or over the greatest offset of a ray
/// along the face.
Fence fence_along(const Rim& rim, const Face& plane, double diagonal) {
  const SurfaceTriangle& face = *rim.face;
  const Vec3d up(face.normal), along = plane.along(rim.corner);
  const Vec3d out = plane.way_out(rim.corner) * double(face.height);
  Fence fence{{}, face.normal};
  for (std::size_t end = 0; end < 2; ++end) {
    const Vec3& corner = face.corners[(rim.corner + end) % 3].position;
    const double moved = rim.along ? start_offset(corner, face.normal) : 0.0;
    const double top = 1.5 * face.height + moved + (rim.along ? grazing_sine * diagonal : 0.0);
    // Coordinates move by float steps of their own, so a start may leave the face sideways, too.
    const Vec3d place = Vec3d(corner) + out + along * (end == 0 ? -moved : moved);
    fence.corners[end] = Vec3(place - up * (2 * face.height));
    fence.corners[3 - end] = Vec3(place + up * top);
  }
  return fence;
}

}  // namespace

std::vector<LightBall> light_balls(const SceneSurvey& survey) {
  std::vector<LightBall> balls;
  for (const LightInfo& light : survey.lights) balls.push_back(ball_of(light));
  return balls;
}

Fences make_fences(const Surface& surface, const std::vector<LightBall>& lights, const Vec2& map) {
  std::vector<Rim> rims = rims_of(surface, lights, map);
  std::stable_sort(rims.begin(), rims.end(), [](const Rim& a, const Rim& b) { return a.edge() < b.edge(); });
  const double diagonal = diagonal_of(surface);
  Fences fences;
  for (auto first = rims.begin(); first != rims.end();) {
    const auto last =
        std::find_if(first, rims.end(), [&](const Rim& it) { return it.edge() != first->edge(); });
    for (auto rim = first; rim != last; ++rim) {
      if (!rim->open || std::any_of(first, last, [&](const Rim& other) { return goes_on(*rim, other); }))
        continue;
      const Face face(*rim->face, map);
      const Fence fence = fence_along(*rim, face, diagonal);
      const double height = (fence.corners[3] - fence.corners[0]).length() / face.texel(map);
      if (height > highest)
        fences.left_out = std::max(fences.left_out, height);
      else
        fences.strips.push_back(fence);
    }
    first = last;
  }
  return fences;
}

}  // namespace rnmbake
