// lightmap/normalize.h - scales the three maps so that a flat normal decodes to the flat bake, as vrad does.
#pragma once

#include "image/float_image.h"

#include <array>
#include <cstddef>

namespace rnmbake {

/// For each texel and colour, multiplies the three values so that their mean is that of `flat` (see
/// rnm_scaled_to_flat()). What the scale was is lost. Texels with a value that is not finite stay as they
/// are. Returns how many values had three zeros under a flat value above 0 and took the flat value instead.
std::size_t normalize_to_flat(const std::array<FloatImage*, 3>& maps, const FloatImage& flat);

}  // namespace rnmbake
