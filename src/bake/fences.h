// bake/fences.h - keeps light that does not rise over a face from its receivers.
//
// Cycles asks only whether a lamp is above the horizon of a receiver's normal; one under the face is left to
// the surface below to block. But a receiver stands a little off it, so light that runs along the face, or
// comes from just under it, slips in over the rim. There fences stand: upright strips that only rays to
// lights meet, and that are opaque to those which do not rise over the face. So the hemisphere is the face's,
// to rounding.
#pragma once

#include "base/math.h"
#include "scene/surface.h"
#include "scene/survey.h"

#include <array>
#include <vector>

namespace rnmbake {

/// A strip along an edge of a face, world space.
struct Fence {
  std::array<Vec3, 4> corners;
  Vec3 up;  // normal of the face, unit
};

/// A lamp or a sun as seen from a face: a ball.
struct LightBall {
  bool far = false;      // a sun
  Vec3d place{0, 0, 0};  // of its centre; of a sun: unit vector towards it
  double radius = 0;     // of a sun: sine of half its angle
};

[[nodiscard]] std::vector<LightBall> light_balls(const SceneSurvey& survey);

struct Fences {
  std::vector<Fence> strips;
  double left_out = 0;  // texels: height of the highest strip that would have shaded too much; 0: all stand
};

/// Along the rims of faces over which such a light would light more than a hundredth of a texel. `map`:
/// texels of the lightmap along u and v. What is so small, or so far off, that Cycles starts rays more than
/// a texel off it has no fence against light that runs along it: the fence's own shadow would show.
[[nodiscard]] Fences make_fences(const Surface& surface, const std::vector<LightBall>& lights,
                                 const Vec2& map);

}  // namespace rnmbake
