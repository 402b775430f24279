// ssbump/map/slope_curl.h - curl of a normal map's slopes, which is 0 for every surface.
#pragma once

#include "image/float_image.h"
#include "image/sample.h"

#include <cstddef>

namespace rnmbake {

/// Slopes p = dh/dx and q = dh/dy of a surface have dp/dy = dq/dx. Their difference is the gain in height on
/// a closed walk around a square, over the square's area.
struct SlopeCurl {
  std::size_t places = 0;  // squares of `scale` texels
  double rms = 0;          // of dp/dy - dq/dx; heights and distances in texels
  double worst = 0;        // largest absolute value,
  int worst_x = 0, worst_y = 0;
  double share_above = 0;  // of the places whose curl is above the bound
  /// RMS of dp/dy - dq/dx over the root of the sum of both mean squares: 0 for heights, 1 for slopes that
  /// have nothing to do with each other, sqrt 2 for pure rotation. 0 where nothing bends.
  double relative = 0;
  double relative_flipped = 0;  // the same with the green channel turned round
};

struct SlopeCurlOptions {
  Border border = Border::wrap;  // with clamp the outermost places are not looked at
  double bound = 0.1;
  int scale = 1;  // slopes are averaged over squares of so many texels first; incomplete squares do not count
};

/// Central differences between the neighbours on either side. Slopes end at 100 (89.4 degrees). `normals`:
/// unit, tangent space, y up.
[[nodiscard]] SlopeCurl slope_curl(const FloatImage& normals, const SlopeCurlOptions& options);

}  // namespace rnmbake
