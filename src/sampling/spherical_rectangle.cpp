#include "sampling/spherical_rectangle.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

constexpr float far = 0.01F;  // side^2 / distance^2
constexpr double smallest_solid_angle =
    1e-5;                               // steradians: below, the sum of four angles loses too many digits
constexpr float right_angle = 1e-4F;    // the largest cosine between the sides
constexpr float nearest_plane = 1e-4F;  // distance to the plane as a share of the sides

}  // namespace

SphericalRectangle::SphericalRectangle(const Vec3& point, const Vec3& centre, const Vec3& half_u,
                                       const Vec3& half_v)
    : point_(point) {
  const float length_u = half_u.length(), length_v = half_v.length();
  if (!(length_u > 0) || !(length_v > 0)) return;
  x_ = half_u / length_u;
  y_ = half_v / length_v;
  if (std::abs(x_.dot(y_)) > right_angle) return;
  z_ = x_.cross(y_);
  const Vec3 to_centre = centre - point;
  // Seen from afar, sampling by area is as good, and cheaper.
  const float nearest = to_centre.length() - (length_u + length_v);
  if (nearest > 0 && 4 * length_u * length_v < far * nearest * nearest) return;
  z0_ = to_centre.dot(z_);
  if (z0_ > 0) {
    z_ = -z_;
    z0_ = -z0_;
  }
  if (-z0_ < nearest_plane * (length_u + length_v)) return;
  x0_ = to_centre.dot(x_) - length_u;
  x1_ = to_centre.dot(x_) + length_u;
  y0_ = to_centre.dot(y_) - length_v;
  y1_ = to_centre.dot(y_) + length_v;

  // The z of the normals of the four planes through the point and a side; x and y follow.
  const double z = z0_;
  const double n0 = -y0_ / std::sqrt(z * z + double(y0_) * y0_),
               n1 = x1_ / std::sqrt(z * z + double(x1_) * x1_);
  const double n2 = y1_ / std::sqrt(z * z + double(y1_) * y1_),
               n3 = -x0_ / std::sqrt(z * z + double(x0_) * x0_);
  const double g0 = std::acos(-n0 * n1), g1 = std::acos(-n1 * n2);
  const double g2 = std::acos(-n2 * n3), g3 = std::acos(-n3 * n0);
  b0_ = n0;
  b1_ = n2;
  k_ = 2 * pi - g2 - g3;
  solid_angle_ = g0 + g1 + g2 + g3 - 2 * pi;
  usable_ = solid_angle_ > smallest_solid_angle;
}

Vec3 SphericalRectangle::sample(const Vec2& u) const {
  const double z0 = z0_, y0 = y0_, y1 = y1_;
  const double au = u.x * solid_angle_ + k_;
  const double fu = (std::cos(au) * b0_ - b1_) / std::sin(au);
  const double cu = std::clamp(std::copysign(1 / std::sqrt(fu * fu + b0_ * b0_), fu), -1.0, 1.0);
  const double side = std::sqrt(std::max(1 - cu * cu, 1e-30));
  const double x = std::clamp(-(cu * z0) / side, double(x0_), double(x1_));
  const double d2 = x * x + z0 * z0;
  const double h0 = y0 / std::sqrt(d2 + y0 * y0), h1 = y1 / std::sqrt(d2 + y1 * y1);
  const double h = h0 + u.y * (h1 - h0), rest = 1 - h * h;
  const double y = rest > 0 ? std::clamp(h * std::sqrt(d2 / rest), y0, y1) : (h > 0 ? y1 : y0);
  return point_ + x_ * static_cast<float>(x) + y_ * static_cast<float>(y) + z_ * z0_;
}

}  // namespace rnmbake
