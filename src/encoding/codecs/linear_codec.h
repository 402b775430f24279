// encoding/codecs/linear_codec.h - codecs whose E/pi is a sum of functions of the normal, fitted to many
// directions.
#pragma once

#include "encoding/codec.h"

#include <memory>
#include <string>

namespace rnmbake {

/// `sh2` (layers l0, l1x, l1y, l1z), `sh3` (sh0 to sh8: radiance, encoding/sh.h), `h4`, `h6` (h0 to h5:
/// encoding/hbasis.h), `sg` (sg0 to sg5: encoding/sg.h). Least squares over all directions of the set; the
/// flat normal returns the flat bake. Throws Error(unsupported), with the remedy, where the set does not hold
/// flat or determines the coefficients so badly that noise may grow more than greatest_condition times.
[[nodiscard]] std::unique_ptr<const Codec> linear_codec(const CodecOptions& options,
                                                        const BasisSet& directions);

/// `rnm-signed`: the integral of L(D) dot(D, B_i) over the hemisphere, with both signs, over pi; decoded with
/// linear weights. BakingLab (Pettineo, Hillaire). What tilted bakes clip is found with the harmonics of
/// `sh3`: E(n) - E(-n) is that integral for any n, and in the harmonics twice their band 1. Layers rnm0 to
/// rnm2.
[[nodiscard]] std::unique_ptr<const Codec> signed_codec(const CodecOptions& options,
                                                        const BasisSet& directions);

inline constexpr double greatest_condition = 100;

/// Condition number of the encoding's fit to the set (encoding/fit/least_squares.h).
[[nodiscard]] double condition_of(const std::string& encoding, const BasisSet& directions);

}  // namespace rnmbake
