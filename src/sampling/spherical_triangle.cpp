#include "sampling/spherical_triangle.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

constexpr float least_sampled = 0.1F, most_sampled = 6.2F;  // steradians

}  // namespace

SphericalTriangle::SphericalTriangle(const Vec3& to_corner, const Vec3& edge1, const Vec3& edge2,
                                     const Vec3& normal, float area) {
  const float height = std::abs(to_corner.dot(normal));
  const float reach2 = std::max(to_corner.length2(), std::max(edge1.length2(), edge2.length2()));
  // Most are far away: an upper bound of the solid angle spares the roots below.
  const Vec3 to_centre = to_corner + (edge1 + edge2) / 3;
  const float radius2 = std::max(edge1.length2(), edge2.length2());
  const float nearest = std::sqrt(to_centre.length2()) - std::sqrt(radius2);
  if (nearest > 0 && area < least_sampled * nearest * nearest) return;
  if (height * height < 1e-8F * reach2) return;
  a_ = to_corner.normalized();
  b_ = (to_corner + edge1).normalized();
  c_ = (to_corner + edge2).normalized();
  // Van Oosterom & Strackee 1983.
  const float volume = std::abs(a_.dot(b_.cross(c_)));
  const float sum = 1 + a_.dot(b_) + b_.dot(c_) + c_.dot(a_);
  const float angle = 2 * std::atan2(volume, sum);
  if (angle > least_sampled && angle < most_sampled) solid_angle_ = angle;
}

Vec3 SphericalTriangle::sample(const Vec2& u) const {
  const Vec3 ab = a_.cross(b_), ac = a_.cross(c_);
  const float alpha = std::atan2(std::abs(ab.cross(ac).length()), ab.dot(ac));
  const float cos_alpha = std::cos(alpha), sin_alpha = std::sin(alpha);
  const float part = u.x * solid_angle_ - alpha;
  const float sine = std::sin(part), cosine = std::cos(part);
  const float p = cosine - cos_alpha, q = sine + sin_alpha * a_.dot(b_);
  const float below = (q * sine + p * cosine) * sin_alpha;
  const float z =
      below == 0 ? 1.0F : std::clamp(((q * cosine - p * sine) * cos_alpha - q) / below, -1.0F, 1.0F);
  const Vec3 side_c = (c_ - a_ * c_.dot(a_)).normalized();
  const Vec3 corner = a_ * z + side_c * std::sqrt(1 - z * z);
  const float w = 1 - u.y * (1 - corner.dot(b_));
  const Vec3 side_b = (corner - b_ * corner.dot(b_)).normalized();
  return b_ * w + side_b * std::sqrt(std::max(1 - w * w, 0.0F));
}

}  // namespace rnmbake
