// trace/lights/light_triangle.h - an emissive triangle, sampled by area where its solid angle is small and by
// solid angle where it is large.
#pragma once

#include "base/math.h"

namespace rnmbake {

struct LightTriangle {
  Vec3 corner{0, 0, 0}, edge1{0, 0, 0}, edge2{0, 0, 0};  // corner 0; from it to corners 1 and 2
  Vec3 normal{0, 0, 1};                                  // unit
  float area = 0;

  /// A point on the triangle; the pdf is per solid angle, 0 from within the triangle's plane.
  struct Sample {
    float b1 = 0, b2 = 0;  // barycentric coordinates of corners 1 and 2
    Vec3 direction{0, 0, 1};
    float distance = 0;
    float pdf = 0;
  };
  [[nodiscard]] Sample sample(const Vec3& point, const Vec2& u) const;
  /// Of sampling the point that a ray from `point` hit.
  [[nodiscard]] float pdf(const Vec3& point, const Vec3& direction, float distance) const;
};

[[nodiscard]] LightTriangle light_triangle(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace rnmbake
