// encoding/codecs/ambient_cube_fit.h - the ambient cube nearest to what is known at many normals.
#pragma once

#include "encoding/ambient_cube.h"
#include "encoding/distant_light.h"

#include <span>

namespace rnmbake {

/// The cube of least squared error; E or E/pi, as `values` are. A side that no normal faces is 0. `weights`:
/// one for each normal, or none.
[[nodiscard]] AmbientCube fit_ambient_cube(std::span<const Vec3> normals, std::span<const Vec3> values,
                                           std::span<const float> weights = {});

/// What quick demos take for an ambient cube: the mean radiance of each face of a cube map, which knows
/// nothing of the cosine, nor of light from the other faces.
[[nodiscard]] AmbientCube face_means(const DistantLight& light);

}  // namespace rnmbake
