// sampling/spherical_triangle.h - a triangle sampled uniformly per solid angle.
//
// Arvo, "Stratified Sampling of Spherical Triangles" (1995).
#pragma once

#include "base/math.h"

namespace rnmbake {

class SphericalTriangle {
 public:
  /// A triangle seen from a point: corner 0 relative to the point, the edges from it to corners 1 and 2, the
  /// unit normal and the area.
  SphericalTriangle(const Vec3& to_corner, const Vec3& edge1, const Vec3& edge2, const Vec3& normal,
                    float area);

  /// False where it is so small that sampling by area is as good and much cheaper, or so large or so nearly
  /// edge-on that floats do not tell its angles apart well enough.
  [[nodiscard]] bool usable() const { return solid_angle_ > 0; }
  [[nodiscard]] float solid_angle() const { return solid_angle_; }

  /// A unit direction into the triangle.
  [[nodiscard]] Vec3 sample(const Vec2& u) const;
  [[nodiscard]] float pdf() const { return 1 / solid_angle_; }

 private:
  Vec3 a_, b_, c_;  // corners on the unit sphere
  float solid_angle_ = 0;
};

}  // namespace rnmbake
