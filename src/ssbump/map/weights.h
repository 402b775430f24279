// ssbump/map/weights.h - weights of a self-shadowed bump map, before they are encoded.
#pragma once

#include "image/float_image.h"

namespace rnmbake {

/// Share of the light along each axis that arrives, with power p (Green, "Efficient Self-Shadowed Radiosity
/// Normal Mapping", SIGGRAPH 2007):
///     s = visible integral of max(0, D . axis)^p dD / the same over the whole upper hemisphere, in [0, 1].
/// Channels 0-2: the Half-Life 2 basis in its order right, upper left, lower left (encoding/rnm.h),
/// right-handed. Channel 3: straight up with the same power. Channel 4: ambient occlusion, straight up with
/// power 1.
struct SsbumpWeights {
  static constexpr int channels = 5, up = 3, ambient = 4;
  FloatImage image;
  int azimuths = 0;  // that the horizon was swept in; 0: another method
  double rmse = -1;  // as estimated; below 0: not known
};

}  // namespace rnmbake
