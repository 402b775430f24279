// lightmap/touched.h - texels that a surface is seen in, whether or not its faces hold their centres.
#pragma once

#include "base/math.h"
#include "lightmap/texel_bits.h"

#include <vector>

namespace rnmbake {

/// Sets every texel that a triangle reaches into by more than 1/256 of its side, which leaves rounding of UVs
/// out; a triangle that reaches so far into none sets the one that it lies in. `corner_uv`: three UVs for
/// each triangle, v up, [0,1] is the map. What lies outside is clipped away.
void set_touched(const std::vector<Vec2>& corner_uv, TexelBits& texels);

}  // namespace rnmbake
