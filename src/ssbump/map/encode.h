// ssbump/map/encode.h - weights to and from a texture's values.
#pragma once

#include "image/float_image.h"
#include "image/picture_rows.h"
#include "ssbump/map/metadata.h"

#include <cstdint>

namespace rnmbake {

struct SsbumpEncoding {
  SsbumpScale scale = SsbumpScale::third;
  Handed handed = Handed::right;
  SsbumpAlpha alpha = SsbumpAlpha::none;
};

/// Encodes weights (SsbumpWeights: five channels) as the three or four channels of a file.
[[nodiscard]] FloatImage encode(const FloatImage& weights, const SsbumpEncoding& encoding);

/// Decodes to SsbumpWeights: up and ambient are 1 where the file does not hold them. Three channels of
/// `stored` are read, a fourth if `encoding.alpha` says so.
[[nodiscard]] FloatImage decode_weights(const FloatImage& stored, const SsbumpEncoding& encoding);

/// Rounds values in [0, 1] to the steps of an integer format, up or down by chance so that the mean stays: no
/// bands in a gradient. Values on a step stay. The pattern depends on seed, texel and channel alone;
/// `first_row` is the picture's row that row 0 of `rows` is. Nothing is done to floats.
void dither(FloatImage& rows, Storage storage, std::uint32_t seed, int first_row);

}  // namespace rnmbake
