// encoding/codecs/packed_codec.h - sh2, zh3 and geomerics as engines' textures hold them.
#pragma once

#include "encoding/codec.h"

#include <memory>

namespace rnmbake {

/// With options.range above 0: layers l0 (a) and t1x, t1y, t1z (t = 1/2 + v / (2 K a), a colour each); with
/// `mono` l0 and dir, whose R, G and B are the t of x, y and z. The flat normal returns the flat bake,
/// rounded or not. Decodes as E = a lobe(1, v / a): Bakery's SH and MonoSH, Godot's lightmaps.
[[nodiscard]] std::unique_ptr<const Codec> packed_codec(const CodecOptions& options,
                                                        const BasisSet& directions);

}  // namespace rnmbake
