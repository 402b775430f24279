// trace/lights/light_rectangle.h - a rectangle sampled uniformly by the solid angle it fills (Urena et al.
// 2013).
#pragma once

#include "base/math.h"

namespace rnmbake {

class SeenRectangle {
 public:
  /// From `point`, with the half sides of a rectangle around `centre`.
  SeenRectangle(const Vec3& point, const Vec3& centre, const Vec3& half_u, const Vec3& half_v);

  /// False where its sides are not at right angles, or where it is too small or the point too near its plane
  /// for the angles to be told apart: sample by area then.
  [[nodiscard]] bool usable() const { return usable_; }
  [[nodiscard]] float solid_angle() const { return static_cast<float>(solid_angle_); }
  /// `u` in [0,1)^2; on the rectangle, with the density 1 / solid_angle().
  [[nodiscard]] Vec3 place(const Vec2& u) const;

 private:
  Vec3 point_, x_, y_, z_;  // the frame of the rectangle; z looks away from the point
  float x0_ = 0, x1_ = 0, y0_ = 0, y1_ = 0, z0_ = 0;  // the rectangle in it, seen from the point
  double b0_ = 0, b1_ = 0, k_ = 0, solid_angle_ = 0;  // the paper's names
  bool usable_ = false;
};

}  // namespace rnmbake
