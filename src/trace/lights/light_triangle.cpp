#include "trace/lights/light_triangle.h"

#include "sampling/maps.h"
#include "sampling/spherical_triangle.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

SphericalTriangle seen_from(const LightTriangle& t, const Vec3& point) {
  return {t.corner - point, t.edge1, t.edge2, t.normal, t.area};
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
  const SphericalTriangle seen = seen_from(*this, point);
  if (seen.usable()) {
    const Vec3 direction = seen.sample(u);
    const Vec3 to_corner = corner - point;
    const float facing = direction.dot(normal);
    if (facing == 0) return place;
    // Barycentric coordinates of where the direction meets the plane.
    const Vec3 on = direction * (to_corner.dot(normal) / facing) - to_corner;
    const float scale = 1 / (2 * area);
    place.b1 = std::clamp(on.cross(edge2).dot(normal) * scale, 0.0F, 1.0F);
    place.b2 = std::clamp(edge1.cross(on).dot(normal) * scale, 0.0F, 1.0F - place.b1);
  } else {
    const Vec2 b = uniform_triangle(u);
    place.b1 = b.x;
    place.b2 = b.y;
  }
  const Vec3 way = corner + edge1 * place.b1 + edge2 * place.b2 - point;
  place.distance = way.length();
  if (!(place.distance > 0)) return place;
  place.direction = way / place.distance;
  const float cosine = std::abs(place.direction.dot(normal));
  if (cosine == 0) return place;
  place.pdf = seen.usable() ? seen.pdf() : place.distance * place.distance / (cosine * area);
  return place;
}

float LightTriangle::pdf(const Vec3& point, const Vec3& direction, float distance) const {
  const SphericalTriangle seen = seen_from(*this, point);
  if (seen.usable()) return seen.pdf();
  const float cosine = std::abs(direction.dot(normal));
  return cosine > 0 ? distance * distance / (cosine * area) : 0.0F;
}

}  // namespace rnmbake
