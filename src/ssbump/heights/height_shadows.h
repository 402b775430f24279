// ssbump/heights/height_shadows.h - the exact shadow that a height field casts on itself: the truth for
// estimates.
#pragma once

#include "base/math.h"
#include "image/float_image.h"
#include "ssbump/heights/height_field.h"

namespace rnmbake {

/// Rays from a texel's centre over the surface of bilinear patches. Exact but for rounding: every patch on
/// the way is met, and the parabola over it has its maximum in closed form.
class HeightRays {
 public:
  explicit HeightRays(const HeightField& field);

  /// The steepest way up from texel (x, y): the largest (h - h0) / distance to any point of the surface
  /// straight in direction `azimuth` (unit, y up), or `floor` where nothing is steeper. `floor` > 0 bounds
  /// the way to (highest height - h0) / floor texels.
  [[nodiscard]] double horizon_slope(int x, int y, const Vec2& azimuth, double floor) const;

  /// Whether light from `light` (unit, towards it) does not reach the texel's centre.
  [[nodiscard]] bool occluded(int x, int y, const Vec3& light) const;

 private:
  enum class Until { end, first_above };
  [[nodiscard]] double steepest(int x, int y, const Vec2& azimuth, double floor, Until until) const;

  const HeightField& field_;
  double highest_ = 0;
};

/// 1 where light from `light` (unit, towards it) reaches a texel's centre, else 0; one channel. With an
/// `angular_radius` (radians) the light is a disc around that direction, and a texel holds the share of it
/// that is seen, out of 64 directions spread evenly.
[[nodiscard]] FloatImage height_shadows(const HeightField& field, const Vec3& light,
                                        double angular_radius = 0);

}  // namespace rnmbake
