// trace/lights/light_triangle.h - a glowing triangle, sampled by area where it looks small and by solid angle
// where it looks large (Arvo 1995).
#pragma once

#include "base/math.h"

namespace rnmbake {

struct LightTriangle {
  Vec3 corner{0, 0, 0}, edge1{0, 0, 0}, edge2{0, 0, 0};  // corner 0; from it to corners 1 and 2
  Vec3 normal{0, 0, 1};                                  // unit
  float area = 0;

  /// A place as barycentric weights of corners 1 and 2, and the density per solid angle that it was chosen
  /// with: 0 where the point lies in the triangle's plane.
  struct Place {
    float b1 = 0, b2 = 0;
    Vec3 direction{0, 0, 1};
    float distance = 0;
    float pdf = 0;
  };
  [[nodiscard]] Place sample(const Vec3& point, const Vec2& u) const;
  /// The density of a place on it that a ray met.
  [[nodiscard]] float pdf(const Vec3& point, const Vec3& direction, float distance) const;
};

[[nodiscard]] LightTriangle light_triangle(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace rnmbake
