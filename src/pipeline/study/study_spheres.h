// pipeline/study/study_spheres.h - a normal-mapped sphere as each encoding shows it.
#pragma once

#include "encoding/distant_light.h"
#include "image/float_image.h"

#include <string>
#include <vector>

namespace rnmbake {

/// E/pi, RGB, over a bumpy sphere each of whose points has a lightmap of its own; black beside it.
struct SpherePicture {
  std::string label;  // as EncodingErrors::label; "truth" of the first
  FloatImage pixels;
  double rms = 0;  // over the sphere's pixels and colours, share of the truth's root mean square
};

/// An even sky, a bright lamp to the upper left and a weak one to the right.
[[nodiscard]] DistantLight sky_and_lamps();

/// Seen along y, z up; bumps tilt normals by up to 50 degrees. The truth first, then the plain and the
/// smallest packed encodings. The surface blocks what is behind it, as a texel's own hemisphere does.
[[nodiscard]] std::vector<SpherePicture> sphere_pictures(const DistantLight& light, int side = 176);

}  // namespace rnmbake
