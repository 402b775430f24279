// encoding/codecs/rnm_codec.h - codecs whose layers are bakes themselves: flat, and the Half-Life 2 basis'
// dialects.
#pragma once

#include "encoding/codec.h"

#include <memory>

namespace rnmbake {

/// `flat`: the plain lightmap, the same for every normal.
[[nodiscard]] std::unique_ptr<const Codec> flat_codec(const BasisSet& directions);

/// `rnm` (clipped maps, squared weights), `rnm-vrad` (the same, scaled so that their mean is flat) and
/// `rnm-bakery` (clipped maps, linear weights, which do not sum to 1): encoding/rnm.h. Layers rnm0 to rnm2.
[[nodiscard]] std::unique_ptr<const Codec> rnm_codec(const std::string& name, const BasisSet& directions);

}  // namespace rnmbake
