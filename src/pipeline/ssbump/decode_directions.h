// pipeline/ssbump/decode_directions.h - light of a lightmap through a self-shadowed bump map of the same set
// of directions.
#pragma once

#include "image/float_image.h"
#include "lightmap/decode.h"
#include "ssbump/map/direction_map.h"

namespace rnmbake {

/// RGB in E/pi, of the map's size; both share one UV layout: E = sum of s_i LM_i, at least 0. The lightmap
/// holds each of the map's directions as it was baked, and may hold more; of one with y down the direction
/// mirrored at x counts. Throws Error(unsupported), naming both sets, where it lacks one, or where it is
/// converted, normalized or not in tangent space.
[[nodiscard]] FloatImage decode_directions(Lightmap lightmap, const DirectionMap& map);

}  // namespace rnmbake
