#include "trace/lights/lamp.h"

#include "sampling/maps.h"
#include "sampling/orthonormal_basis.h"
#include "sampling/spherical_rectangle.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

/// Direction and distance from `point` to `target`; distance 0 where they coincide.
LightSample towards(const Vec3& point, const Vec3& target) {
  LightSample sample;
  const Vec3 to_target = target - point;
  sample.distance = to_target.length();
  if (sample.distance > 0) sample.direction = to_target / sample.distance;
  return sample;
}

LightSample sample_point(const Lamp& lamp, const Vec3& point) {
  LightSample sample = towards(point, lamp.position);
  if (sample.distance == 0) return {};
  const float share = spot_share(lamp.spot, -sample.direction);
  sample.radiance = lamp.radiance * (share / (sample.distance * sample.distance));
  sample.pdf = share > 0 ? 1.0F : 0.0F;
  return sample;
}

/// Samples the cone of directions that the disk is from `point`, with the same radiance from each.
LightSample sample_disk(const Lamp& lamp, const Vec3& point, const Vec2& u) {
  const LightSample centre = towards(point, lamp.position);
  if (centre.distance == 0) return {};
  const float ratio = lamp.radius / centre.distance;
  const float slant = std::sqrt(1 + ratio * ratio);            // 1 / cosine at the rim
  const float height = ratio * ratio / (slant * (slant + 1));  // 1 - cosine, without cancellation
  const Vec3 local = uniform_cone(height, u);
  LightSample sample;
  sample.direction = OrthonormalBasis(centre.direction).to_world(local);
  sample.distance = centre.distance / std::max(local.z, 1e-6F);
  sample.radiance = lamp.radiance * spot_share(lamp.spot, -sample.direction);
  sample.pdf = sample.radiance == Vec3(0, 0, 0) ? 0.0F : uniform_cone_pdf(height);
  return sample;
}

/// Distance along a ray to where it leaves (`inside`) or enters a sphere.
float sphere_distance(const Vec3& to_centre, const Vec3& direction, float radius, bool inside) {
  const float along = to_centre.dot(direction);
  const float aside2 = (to_centre - direction * along).length2();
  const float half = std::sqrt(std::max(radius * radius - aside2, 0.0F));
  return std::max(inside ? along + half : along - half, 0.0F);
}

LightSample sample_sphere(const Lamp& lamp, const Vec3& point, const Vec2& u) {
  const LightSample centre = towards(point, lamp.position);
  const Vec3 to_centre = lamp.position - point;
  const bool inside = centre.distance <= lamp.radius;
  LightSample sample;
  float height = 2;
  if (inside) {
    sample.direction = uniform_cone(2, u);
  } else {
    const float sine = lamp.radius / centre.distance;
    height = sine * sine / (1 + std::sqrt(1 - sine * sine));
    sample.direction = OrthonormalBasis(centre.direction).to_world(uniform_cone(height, u));
  }
  sample.distance = sphere_distance(to_centre, sample.direction, lamp.radius, inside);
  sample.radiance = lamp.radiance * (inside ? 1.0F : spot_share(lamp.spot, -sample.direction));
  sample.pdf = sample.radiance == Vec3(0, 0, 0) ? 0.0F : uniform_cone_pdf(height);
  return sample;
}

LightSample sample_sun(const Lamp& lamp, const Vec2& u) {
  LightSample sample;
  sample.distance = infinity;
  sample.radiance = lamp.radiance;
  sample.pdf = 1;
  if (lamp.radius == 0) {
    sample.direction = -lamp.axis;
    return sample;
  }
  const OrthonormalBasis frame(-lamp.axis);
  if (lamp.flat_sun) {
    const Vec2 on_disk = uniform_disk(u) * lamp.radius;
    const float slant = std::sqrt(1 + on_disk.length2());
    sample.direction = frame.to_world(Vec3(on_disk.x, on_disk.y, 1) / slant);
    sample.pdf = slant * slant * slant / (pi_f * lamp.radius * lamp.radius);
    sample.radiance = lamp.radiance * (slant * slant * slant);
    return sample;
  }
  const float slant = std::sqrt(1 + lamp.radius * lamp.radius);
  const float height = lamp.radius * lamp.radius / (slant * (slant + 1));
  sample.direction = frame.to_world(uniform_cone(height, u));
  sample.pdf = uniform_cone_pdf(height);
  return sample;
}

/// The part of an area's sides [-1, 1] whose spread reaches a point.
struct Reach {
  float u0 = -1, u1 = 1, v0 = -1, v1 = 1;
  [[nodiscard]] bool empty() const { return u0 >= u1 || v0 >= v1; }
};

Reach reach_of(const Lamp& lamp, const Vec3& point, float height) {
  Reach reach;
  if (lamp.spread_tangent == 0) return reach;
  const Vec3 from_centre = point - lamp.position;
  const float radius = height * lamp.spread_tangent * 1.0001F;
  const auto clip = [&](const Vec3& half, float& from, float& to) {
    const float length2 = half.length2(), centre = from_centre.dot(half) / length2,
                range = radius / std::sqrt(length2);
    from = std::max(from, centre - range);
    to = std::min(to, centre + range);
  };
  if (std::abs(lamp.u.dot(lamp.v)) > 1e-4F * lamp.u.length() * lamp.v.length()) return reach;  // sheared
  clip(lamp.u, reach.u0, reach.u1);
  clip(lamp.v, reach.v0, reach.v1);
  return reach;
}

/// Turns a point on an area, sampled with `area_pdf` per area, into a sample per solid angle.
LightSample by_area(const Lamp& lamp, const Vec3& point, const Vec3& on_lamp, float area_pdf) {
  LightSample sample = towards(point, on_lamp);
  const float cosine = -sample.direction.dot(lamp.axis);
  if (sample.distance == 0 || cosine <= 0) return {};
  const float share = spread_share(lamp, cosine);
  sample.radiance = lamp.radiance * share;
  sample.pdf = share > 0 ? area_pdf * sample.distance * sample.distance / cosine : 0.0F;
  return sample;
}

LightSample sample_rectangle(const Lamp& lamp, const Vec3& point, const Vec2& u) {
  const float height = (point - lamp.position).dot(lamp.axis);
  if (height <= 0) return {};
  const Reach reach = reach_of(lamp, point, height);
  if (reach.empty()) return {};
  const Vec3 half_u = lamp.u * ((reach.u1 - reach.u0) / 2), half_v = lamp.v * ((reach.v1 - reach.v0) / 2);
  const Vec3 centre =
      lamp.position + lamp.u * ((reach.u1 + reach.u0) / 2) + lamp.v * ((reach.v1 + reach.v0) / 2);
  const SphericalRectangle seen(point, centre, half_u, half_v);
  if (!seen.usable()) {
    const Vec3 on_lamp = centre + half_u * (2 * u.x - 1) + half_v * (2 * u.y - 1);
    return by_area(lamp, point, on_lamp, 1 / (4 * half_u.cross(half_v).length()));
  }
  LightSample sample = towards(point, seen.sample(u));
  const float cosine = -sample.direction.dot(lamp.axis);
  const float share = cosine > 0 ? spread_share(lamp, cosine) : 0.0F;
  sample.radiance = lamp.radiance * share;
  sample.pdf = share > 0 && sample.distance > 0 ? seen.pdf() : 0.0F;
  return sample;
}

/// Samples the ellipse, or the rectangle that the spread reaches where that is smaller; of it, points off the
/// ellipse carry nothing.
LightSample sample_ellipse(const Lamp& lamp, const Vec3& point, const Vec2& u) {
  const float height = (point - lamp.position).dot(lamp.axis);
  if (height <= 0) return {};
  const Reach reach = reach_of(lamp, point, height);
  if (reach.empty()) return {};
  const float share = (reach.u1 - reach.u0) * (reach.v1 - reach.v0);
  Vec2 on_disk = uniform_disk(u);
  float area = pi_f;
  if (share < area) {
    area = share;
    on_disk = Vec2(reach.u0 + u.x * (reach.u1 - reach.u0), reach.v0 + u.y * (reach.v1 - reach.v0));
    if (on_disk.length2() > 1) return {};
  }
  return by_area(lamp, point, lamp.position + lamp.u * on_disk.x + lamp.v * on_disk.y,
                 1 / (area * lamp.u.cross(lamp.v).length()));
}

}  // namespace

float Lamp::area() const {
  return u.cross(v).length() * (kind == Kind::ellipse ? pi_f : 4.0F);
}

float spot_share(const SpotCone& cone, const Vec3& emitted) {
  if (!cone.used) return 1;
  const Vec3 local(cone.x.dot(emitted), cone.y.dot(emitted), cone.z.dot(emitted));
  const float z = local.z / local.length();
  if (!(z > cone.cosine)) return 0;
  const float t = cone.sharpness == 0 ? 1.0F : std::min((z - cone.cosine) * cone.sharpness, 1.0F);
  return t * t * (3 - 2 * t) * (cone.by_cosine ? z : 1.0F);
}

float spread_share(const Lamp& lamp, float cosine) {
  if (lamp.spread_tangent == 0) return 1;
  const float tangent = std::sqrt(std::max(1 - cosine * cosine, 0.0F)) / cosine;
  return std::max(1 - tangent / lamp.spread_tangent, 0.0F) * lamp.spread_scale;
}

namespace {

LightSample sample_kind(const Lamp& lamp, const Vec3& point, const Vec2& u) {
  switch (lamp.kind) {
    case Lamp::Kind::point:
      return sample_point(lamp, point);
    case Lamp::Kind::disk:
      return sample_disk(lamp, point, u);
    case Lamp::Kind::sphere:
      return sample_sphere(lamp, point, u);
    case Lamp::Kind::sun:
      return sample_sun(lamp, u);
    case Lamp::Kind::rectangle:
      return sample_rectangle(lamp, point, u);
    case Lamp::Kind::ellipse:
      return sample_ellipse(lamp, point, u);
  }
  return {};
}

}  // namespace

LightSample sample_lamp(const Lamp& lamp, const Vec3& point, const Vec2& u) {
  LightSample sample = sample_kind(lamp, point, u);
  sample.max_bounces = lamp.max_bounces;
  return sample;
}

}  // namespace rnmbake
