// ssbump/map/encode.h - weights to and from the numbers that a texture stores.
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

/// Weights (SsbumpWeights: five channels) to what the file holds: three channels, or four.
[[nodiscard]] FloatImage encode(const FloatImage& weights, const SsbumpEncoding& encoding);

/// The way back, to SsbumpWeights: what the file does not hold of up and ambient is 1. Three channels of
/// `stored` are read, a fourth if `encoding.alpha` says so.
[[nodiscard]] FloatImage decode_weights(const FloatImage& stored, const SsbumpEncoding& encoding);

/// Rounds values in [0, 1] to the steps of an integer format, up or down by chance so that the mean stays:
/// no bands in a gradient. What lies on a step stays there. The pattern depends on seed, texel and channel
/// alone; `first_row` is the picture's row that row 0 of `rows` is. Nothing is done to floats.
void dither(FloatImage& rows, Storage storage, std::uint32_t seed, int first_row);

}  // namespace rnmbake
