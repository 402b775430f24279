#include "trace/lights/light_bounds.h"

#include "base/math.h"
#include "sampling/maps.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

void bound_area(const Lamp& lamp, LightBounds& bounds) {
  for (int k = 0; k < 3; ++k) {
    const float reach = lamp.kind == Lamp::Kind::ellipse ? std::hypot(lamp.u[k], lamp.v[k])
                                                         : std::abs(lamp.u[k]) + std::abs(lamp.v[k]);
    bounds.low[k] = lamp.position[k] - reach;
    bounds.high[k] = lamp.position[k] + reach;
  }
  bounds.axis = lamp.axis;
  bounds.normals = 1;
  bounds.power = mean_magnitude(lamp.radiance) * lamp.area() * lamp.spread_scale;
  if (lamp.spread_tangent > 0) bounds.emission = 1 / std::sqrt(1 + lamp.spread_tangent * lamp.spread_tangent);
}

/// Cosine of the widest half angle of the cone in world space, where scaled lamps have elliptic cones. -1:
/// not bounded.
float widest_cosine(const SpotCone& cone) {
  if (cone.cosine <= 0) return -1;
  const float tangent = std::sqrt(1 - cone.cosine * cone.cosine) / cone.cosine;
  const float widest = std::max(1 / cone.x.length(), 1 / cone.y.length()) * cone.z.length() * tangent;
  return 1 / std::sqrt(1 + widest * widest);
}

}  // namespace

LightBounds lamp_bounds(const Lamp& lamp) {
  LightBounds bounds;
  if (lamp.kind == Lamp::Kind::rectangle || lamp.kind == Lamp::Kind::ellipse) {
    bound_area(lamp, bounds);
    return bounds;
  }
  const Vec3 reach(lamp.radius, lamp.radius, lamp.radius);
  bounds.low = lamp.position - reach;
  bounds.high = lamp.position + reach;
  bounds.power = mean_magnitude(lamp.radiance);
  if (lamp.radius > 0) bounds.power *= pi_f * lamp.radius * lamp.radius;
  if (lamp.spot.used) {
    const float cosine = widest_cosine(lamp.spot);
    bounds.axis = lamp.axis;
    bounds.normals = cosine > 0 ? 1.0F : -1.0F;
    bounds.emission = std::max(cosine, 0.0F);
  }
  return bounds;
}

LightBounds emissive_triangle_bounds(const EmissiveTriangle& emitter) {
  LightBounds bounds;
  const Vec3& a = emitter.shape.corner;
  const Vec3 b = a + emitter.shape.edge1, c = a + emitter.shape.edge2;
  for (int k = 0; k < 3; ++k) {
    bounds.low[k] = std::min({a[k], b[k], c[k]});
    bounds.high[k] = std::max({a[k], b[k], c[k]});
  }
  bounds.axis = emitter.shape.normal;
  bounds.normals = 1;
  bounds.two_sided = true;
  bounds.power = emitter.brightness * emitter.shape.area;
  return bounds;
}

}  // namespace rnmbake
