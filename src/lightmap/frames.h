// lightmap/frames.h - the tangent frames that a bake with --frames stores beside its maps.
#pragma once

#include "encoding/texel_frame.h"
#include "image/float_image.h"
#include "lightmap/metadata.h"

#include <optional>

namespace rnmbake {

/// The frame, in world space, that the pictures `tangent` (X, Y, Z and the bitangent's sign S) and `normal`
/// hold for a texel; nothing where they are 0 or empty. `green`: where the tangent space of the lightmap has
/// its y.
[[nodiscard]] std::optional<TexelFrame> frame_at(const FloatImage& tangent, const FloatImage& normal, int x,
                                                 int y, Green green);

}  // namespace rnmbake
