// ssbump/normal_shadows/lightmap_shadows.h - normal mapping shadows under baked light: our extension of the
// published method.
#pragma once

#include "image/float_image.h"
#include "ssbump/normal_shadows/normal_shadows.h"

#include <array>

namespace rnmbake {

/// The maps of a lightmap that hold a clipped hemisphere integral in E/pi, RGB, all of one size.
struct BakedLight {
  FloatImage flat;
  std::array<FloatImage, 3> rnm;
  FloatImage coverage;  // one channel, may be empty
  bool y_down = false;  // its tangent space
};

/// Repeats of the normal map over the lightmap, along each axis.
struct Repeat {
  int u = 1, v = 1;
};

/// The decoded lightmap in E/pi, RGB, with the normal map's shadows: at each texel the SH-2 fit gives the
/// dominant direction, normal_shadows.h the light that is left of it, and the directional part alone is
/// shadowed. Of the normal map's size times `repeat`; `normals` as in normal_shadows.h.
[[nodiscard]] FloatImage lightmap_shadows(const FloatImage& normals, const BakedLight& baked,
                                          const Repeat& repeat, const NormalShadowOptions& options);

}  // namespace rnmbake
