// trace/lights/lamp.h - a lamp in plain numbers, and sampling it from a point. Lamps block no rays.
#pragma once

#include "base/math.h"
#include "trace/lights/light_sample.h"

namespace rnmbake {

/// The cone of a spot, whose emission is multiplied by spot_share().
struct SpotCone {
  bool used = false;
  // Rows that take a direction into the lamp's own frame, z along its axis.
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  float cosine = -1;       // at the cone's edge
  float sharpness = 0;     // 1 / the cosines over which light fades in; 0: at once
  bool by_cosine = false;  // Blender before 3.5: also multiplied by the cosine off the axis
};
[[nodiscard]] float spot_share(const SpotCone& cone, const Vec3& emitted);

struct Lamp {
  /// point: no size. disk: faces every point that it lights, which Blender calls soft fall-off.
  enum class Kind { point, disk, sphere, sun, rectangle, ellipse };
  Kind kind = Kind::point;
  Vec3 position{0, 0, 0};
  Vec3 axis{0, 0, -1};     // unit; direction that a sun, a spot or an area emits along
  Vec3 radiance{0, 0, 0};  // point: radiant intensity; sun without size: irradiance at normal incidence
  int max_bounces = 1024;  // LightSample::max_bounces
  float radius = 0;        // disk, sphere; of a sun: tangent of half its angle
  bool flat_sun = false;   // the sun is a flat disk, uniform per area, not per solid angle
  SpotCone spot;
  Vec3 u{0, 0, 0}, v{0, 0, 0};  // half sides or half axes of an area
  float spread_tangent = 0;     // of half the spread; 0: all of the hemisphere
  float spread_scale = 1;       // keeps the power as the spread narrows

  [[nodiscard]] float area() const;  // of rectangle and ellipse
};

/// Share of `radiance` that an area emits at an angle to its axis; `cosine` in (0, 1].
[[nodiscard]] float spread_share(const Lamp& lamp, float cosine);

/// Samples the lamp; the pdf lacks the choice of the lamp, and is 0 where no light arrives.
[[nodiscard]] LightSample sample_lamp(const Lamp& lamp, const Vec3& point, const Vec2& u);

}  // namespace rnmbake
