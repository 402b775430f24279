// ssbump/map/normal_map.h - the tangent-space normals of a picture as unit vectors, y up; strict about what
// is none.
#pragma once

#include "image/float_image.h"
#include "image/layered_exr.h"

#include <string>

namespace rnmbake {

struct NormalMapFormat {
  bool two_channel = false;  // x and y are the first two channels, z = sqrt(1 - x^2 - y^2)
  bool y_down = false;       // green points down (Unreal, Source)
};

/// Three channels, unit length, y up. Texels are unpacked as 2t - 1 unless one is below 0 or the channels are
/// X,Y,Z: then they are vectors already. Two channels are taken as x and y. Throws Error(invalid_input),
/// naming `file` and the texel, where there is no such layer, a value is NaN or infinite, a vector is shorter
/// than 0.1, or more than 1 % of them point below the surface, as in a picture that holds no normals.
[[nodiscard]] FloatImage unit_normals(const LayeredImage& picture, const std::string& file,
                                      const NormalMapFormat& format);

}  // namespace rnmbake
