// encoding/flip_green.h - between tangent spaces whose y points up and down (green of a normal map).
#pragma once

#include "base/math.h"

#include <array>
#include <cstddef>

namespace rnmbake {

/// The same direction with the bitangent turned round; its own inverse.
[[nodiscard]] inline Vec3 flip_green(const Vec3& v) {
  return {v.x, -v.y, v.z};
}

/// Coefficients of encoding/sh.h that change their sign by that: (1,-1), (2,-2), (2,-1) are odd in y.
inline constexpr std::array<std::size_t, 3> sh_odd_in_y{1, 4, 5};

}  // namespace rnmbake
