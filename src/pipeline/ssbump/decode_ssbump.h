// pipeline/ssbump/decode_ssbump.h - light of a lightmap through a self-shadowed bump map, as a shader
// computes it.
#pragma once

#include "image/float_image.h"
#include "lightmap/decode.h"
#include "ssbump/map/picture.h"

namespace rnmbake {

/// RGB in E/pi, of the map's size; both share one UV layout. With weights w that are 1 in the open,
///     E = (w_0 LM_0 + w_1 LM_1 + w_2 LM_2) / 3,
/// which is sum of s_i LM_i for what the scale "third" stores and the same energy for the others. Where a
/// fourth channel holds the light from straight above, what the three maps share counts as coming from there:
///     m = min(LM_0, LM_1, LM_2),  E = (sum of w_i (LM_i - m)) / 3 + w_up m.
/// With power 1 that is exact under a uniform sky. vrad scales the three maps so that an open surface gets
/// the flat bake, else they are taken as they are. The lightmap's green and the map's handedness are both
/// followed. Throws as LightmapDecoder.
[[nodiscard]] FloatImage decode_ssbump(Lightmap lightmap, const SsbumpPicture& ssbump, DecodeVariant variant);

}  // namespace rnmbake
