// pipeline/deliver/page_texels.h - pictures as the bytes of a texture, and what a graphics card sees of them.
#pragma once

#include "image/float_image.h"
#include "image/ktx2.h"

#include <string>

namespace rnmbake {

struct EncodedTexels {
  std::string bytes;  // as Ktx2Texture has them
  FloatImage seen;    // three channels
};

/// Three channels; alpha, where the format has one, is 1.
[[nodiscard]] EncodedTexels encode_texels(TexelFormat format, const FloatImage& image);

}  // namespace rnmbake
