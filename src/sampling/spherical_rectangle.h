// sampling/spherical_rectangle.h - a rectangle sampled uniformly per solid angle.
//
// Urena, Fajardo and King, "An Area-Preserving Parametrization for Spherical Rectangles" (2013).
#pragma once

#include "base/math.h"

namespace rnmbake {

class SphericalRectangle {
 public:
  /// Seen from `point`: the rectangle around `centre` with these half sides.
  SphericalRectangle(const Vec3& point, const Vec3& centre, const Vec3& half_u, const Vec3& half_v);

  /// False where its sides are not orthogonal, or where it is too small or the point too near its plane for
  /// floats to tell its angles apart: sample by area then.
  [[nodiscard]] bool usable() const { return usable_; }
  [[nodiscard]] float solid_angle() const { return static_cast<float>(solid_angle_); }
  /// A point on the rectangle.
  [[nodiscard]] Vec3 sample(const Vec2& u) const;
  [[nodiscard]] float pdf() const { return 1 / solid_angle(); }

 private:
  Vec3 point_, x_, y_, z_;  // the frame of the rectangle; z looks away from the point
  float x0_ = 0, x1_ = 0, y0_ = 0, y1_ = 0, z0_ = 0;  // the rectangle in it, seen from the point
  double b0_ = 0, b1_ = 0, k_ = 0, solid_angle_ = 0;  // the paper's names
  bool usable_ = false;
};

}  // namespace rnmbake
