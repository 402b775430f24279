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

LightTriangle::Sample LightTriangle::sample(const Vec3& point, const Vec2& u) const {
  Sample sample;
  const SphericalTriangle seen = seen_from(*this, point);
  if (seen.usable()) {
    const Vec3 direction = seen.sample(u);
    const Vec3 to_corner = corner - point;
    const float facing = direction.dot(normal);
    if (facing == 0) return sample;
    // Barycentric coordinates of where the direction meets the plane.
    const Vec3 on = direction * (to_corner.dot(normal) / facing) - to_corner;
    const float scale = 1 / (2 * area);
    sample.b1 = std::clamp(on.cross(edge2).dot(normal) * scale, 0.0F, 1.0F);
    sample.b2 = std::clamp(edge1.cross(on).dot(normal) * scale, 0.0F, 1.0F - sample.b1);
  } else {
    const Vec2 b = uniform_triangle(u);
    sample.b1 = b.x;
    sample.b2 = b.y;
  }
  const Vec3 to_sample = corner + edge1 * sample.b1 + edge2 * sample.b2 - point;
  sample.distance = to_sample.length();
  if (!(sample.distance > 0)) return sample;
  sample.direction = to_sample / sample.distance;
  const float cosine = std::abs(sample.direction.dot(normal));
  if (cosine == 0) return sample;
  sample.pdf = seen.usable() ? seen.pdf() : sample.distance * sample.distance / (cosine * area);
  return sample;
}

float LightTriangle::pdf(const Vec3& point, const Vec3& direction, float distance) const {
  const SphericalTriangle seen = seen_from(*this, point);
  if (seen.usable()) return seen.pdf();
  const float cosine = std::abs(direction.dot(normal));
  return cosine > 0 ? distance * distance / (cosine * area) : 0.0F;
}

}  // namespace rnmbake
