// ssbump/map/compression_error.h - error of light and bent normals in a compressed format.
#pragma once

#include "image/float_image.h"
#include "ssbump/map/encode.h"
#include "texture/block_compression.h"

namespace rnmbake {

/// Errors of a map after compression. Diffuse: over lights of one strength from all over the upper
/// hemisphere, E = sum of s_i LM_i with LM_i = sat(l . B_i); errors are shares of the RMS of what an open
/// flat surface receives. Angles: of the bent normal, in degrees; a reflection about it is off by twice as
/// much.
struct CompressionError {
  double diffuse_rms = 0, diffuse_bias = 0, diffuse_max = 0;  // max: the worst texel, RMS over lights
  double angle_mean = 0, angle_p95 = 0, angle_max = 0;        // texels whose weights are all 0 have no normal
};

/// Both as SsbumpWeights, of one size.
[[nodiscard]] CompressionError weights_error(const FloatImage& changed, const FloatImage& weights);

/// Encodes, sends the three channels through the format, decodes and compares.
[[nodiscard]] CompressionError compression_error(const FloatImage& weights, SsbumpEncoding encoding,
                                                 TextureFormat format);

}  // namespace rnmbake
