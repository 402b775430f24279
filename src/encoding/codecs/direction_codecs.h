// encoding/codecs/direction_codecs.h - codecs of one direction for all colours of a texel.
#pragma once

#include "encoding/codec.h"

#include <memory>

namespace rnmbake {

/// `ahd`: layers ambient, directional, direction (unit vector). The direction is that with which the mean of
/// R, G and B returns its four bakes; each colour then keeps its flat bake and errs least at the other three.
/// Nothing in the layers is negative.
[[nodiscard]] std::unique_ptr<const Codec> ahd_codec(const CodecOptions& options, const BasisSet& directions);

/// `dominant`: layers colour (the flat bake), direction (d/2 + 1/2) and directionality (in R, G and B alike).
/// d errs least for the mean of R, G and B within |d| <= 1, beyond which decodes are negative somewhere;
/// texels whose free fit lies beyond are counted as out of range.
[[nodiscard]] std::unique_ptr<const Codec> dominant_codec(const CodecOptions& options,
                                                          const BasisSet& directions);

}  // namespace rnmbake
