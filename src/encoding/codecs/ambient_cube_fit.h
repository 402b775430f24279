// encoding/codecs/ambient_cube_fit.h - the ambient cube nearest to what is known at many normals.
#pragma once

#include "encoding/ambient_cube.h"

#include <span>

namespace rnmbake {

/// The cube of least squared error; E or E/pi, as `values` are. A side that no normal faces is 0. `weights`:
/// one for each normal, or none.
[[nodiscard]] AmbientCube fit_ambient_cube(std::span<const Vec3> normals, std::span<const Vec3> values,
                                           std::span<const float> weights = {});

}  // namespace rnmbake
