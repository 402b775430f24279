// image/bakes.h - what was baked for one target, before it is merged into a lightmap.
#pragma once

#include "base/math.h"
#include "image/float_image.h"

#include <string>
#include <vector>

namespace rnmbake {

/// What was baked for one direction: `name` is "flat", "rnm0" .. "rnm2", or the name given in a basis file.
struct BasisBake {
  std::string name;
  Vec3 direction;       // tangent space, unit length
  FloatImage radiance;  // RGB, E/pi
};

/// Everything that Blender returned for one target. All images have the size of `coverage`.
struct TargetBakes {
  std::vector<BasisBake> bases;
  FloatImage coverage;  // one channel: 1 where a texel centre lies in a face, else 0
  FloatImage tangent;   // world-space tangent (unit, xyz) + sign of the bitangent as 4th channel;
  FloatImage normal;    // world-space normal; both empty unless frames were asked for
};

}  // namespace rnmbake
