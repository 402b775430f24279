// encoding/lobe_codec.h - codecs of four numbers for each colour, a and v.
#pragma once

#include "encoding/codec.h"

#include <memory>

namespace rnmbake {

/// `sh2` (interpolates the four bakes), `zh3` and `geomerics` (refitted so that the decoder returns the four
/// bakes: encoding/refit.h). Layers l0 (a), l1x, l1y, l1z (v), E/pi.
[[nodiscard]] std::unique_ptr<const Codec> lobe_codec(const CodecOptions& options,
                                                      const BasisSet& directions);

}  // namespace rnmbake
