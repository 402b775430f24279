#include "trace/lights/light_triangle.h"

#include "sampling/warps.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

// In steradians. Below the first, sampling by area is as good and much cheaper; above the second, the angles
// of a spherical triangle are not told apart well enough in floats.
constexpr float smallest = 0.1F, largest = 6.2F;

/// The triangle on the unit sphere around a point.
struct SeenTriangle {
  Vec3 a, b, c;
  float solid_angle = 0;  // 0: not to be used
};

SeenTriangle seen_from(const LightTriangle& t, const Vec3& point) {
  SeenTriangle seen;
  const Vec3 to_corner = t.corner - point;
  const float height = std::abs(to_corner.dot(t.normal));
  const float reach2 = std::max(to_corner.length2(), std::max(t.edge1.length2(), t.edge2.length2()));
  // Seldom near enough: an upper bound of the solid angle spares the roots below.
  const Vec3 to_centre = to_corner + (t.edge1 + t.edge2) / 3;
  const float radius2 = std::max(t.edge1.length2(), t.edge2.length2());
  const float ray_offset = std::sqrt(to_centre.length2()) - std::sqrt(radius2);
  if (ray_offset > 0 && t.area < smallest * ray_offset * ray_offset) return seen;
  if (height * height < 1e-8F * reach2) return seen;
  seen.a = to_corner.normalized();
  seen.b = (to_corner + t.edge1).normalized();
  seen.c = (to_corner + t.edge2).normalized();
  // Van Oosterom & Strackee 1983.
  const float volume = std::abs(seen.a.dot(seen.b.cross(seen.c)));
  const float sum = 1 + seen.a.dot(seen.b) + seen.b.dot(seen.c) + seen.c.dot(seen.a);
  const float angle = 2 * std::atan2(volume, sum);
  if (angle > smallest && angle < largest) seen.solid_angle = angle;
  return seen;
}

/// Uniform on the spherical triangle.
Vec3 direction_in(const SeenTriangle& s, const Vec2& u) {
  const Vec3 ab = s.a.cross(s.b), ac = s.a.cross(s.c);
  const float alpha = std::atan2(std::abs(ab.cross(ac).length()), ab.dot(ac));
  const float cos_alpha = std::cos(alpha), sin_alpha = std::sin(alpha);
  const float part = u.x * s.solid_angle - alpha;
  const float sine = std::sin(part), cosine = std::cos(part);
  const float p = cosine - cos_alpha, q = sine + sin_alpha * s.a.dot(s.b);
  const float below = (q * sine + p * cosine) * sin_alpha;
  const float z =
      below == 0 ? 1.0F : std::clamp(((q * cosine - p * sine) * cos_alpha - q) / below, -1.0F, 1.0F);
  const Vec3 side_c = (s.c - s.a * s.c.dot(s.a)).normalized();
  const Vec3 corner = s.a * z + side_c * std::sqrt(1 - z * z);
  const float w = 1 - u.y * (1 - corner.dot(s.b));
  const Vec3 side_b = (corner - s.b * corner.dot(s.b)).normalized();
  return s.b * w + side_b * std::sqrt(std::max(1 - w * w, 0.0F));
}

}  // namespace

LightTriangle light_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  LightTriangle t;
  t.corner = a;
  t.edge1 = b - a;
  t.edge2 = c - a;
  const Vec3d normal = Vec3d(t.edge1).cross(Vec3d(t.edge2));
  const double length = normal.length();
  t.area = static_cast<float>(length / 2);
  if (t.area > 0) t.normal = Vec3(normal / length);
  return t;
}

LightTriangle::Place LightTriangle::sample(const Vec3& point, const Vec2& u) const {
  Place place;
  const SeenTriangle seen = seen_from(*this, point);
  if (seen.solid_angle > 0) {
    const Vec3 direction = direction_in(seen, u);
    const Vec3 to_corner = corner - point;
    const float facing = direction.dot(normal);
    if (facing == 0) return place;
    // Where the direction meets the plane, in weights of the corners.
    const Vec3 on = direction * (to_corner.dot(normal) / facing) - to_corner;
    const float scale = 1 / (2 * area);
    place.b1 = std::clamp(on.cross(edge2).dot(normal) * scale, 0.0F, 1.0F);
    place.b2 = std::clamp(edge1.cross(on).dot(normal) * scale, 0.0F, 1.0F - place.b1);
  } else {
    const float root = std::sqrt(u.x);
    place.b1 = root * (1 - u.y);
    place.b2 = root * u.y;
  }
  const Vec3 way = corner + edge1 * place.b1 + edge2 * place.b2 - point;
  place.distance = way.length();
  if (!(place.distance > 0)) return place;
  place.direction = way / place.distance;
  const float cosine = std::abs(place.direction.dot(normal));
  if (cosine == 0) return place;
  place.pdf = seen.solid_angle > 0 ? 1 / seen.solid_angle : place.distance * place.distance / (cosine * area);
  return place;
}

float LightTriangle::pdf(const Vec3& point, const Vec3& direction, float distance) const {
  const SeenTriangle seen = seen_from(*this, point);
  if (seen.solid_angle > 0) return 1 / seen.solid_angle;
  const float cosine = std::abs(direction.dot(normal));
  return cosine > 0 ? distance * distance / (cosine * area) : 0.0F;
}

}  // namespace rnmbake
