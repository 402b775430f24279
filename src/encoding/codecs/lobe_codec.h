// encoding/codecs/lobe_codec.h - codecs of four numbers for each colour, a and v.
#pragma once

#include "encoding/codec.h"
#include "encoding/lobe.h"
#include "encoding/refit/refit.h"

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rnmbake {

/// `sh2` (interpolates the four bakes; of more directions: encoding/codecs/linear_codec.h), `zh3` and
/// `geomerics` (refitted so that the decoder returns the four bakes: encoding/refit/refit.h). Layers l0 (a),
/// l1x, l1y, l1z (v), E/pi.
[[nodiscard]] std::unique_ptr<const Codec> lobe_codec(const CodecOptions& options,
                                                      const BasisSet& directions);

/// Decoder of that name, and its bound.
struct BoundedLobe {
  Lobe lobe;
  LeastOfLobe least;

  /// No value of (a, v), |v| <= 2a or not, is below it at a normal tilted up to 60 degrees off `up`.
  [[nodiscard]] double least_about(const Vec3d& up, double a, const Vec3d& v) const;
};
[[nodiscard]] BoundedLobe lobe_of(const std::string& encoding);

/// Where flat, rnm0, rnm1 and rnm2 stand among the directions. Throws as needed_direction().
using FourPlaces = std::array<std::size_t, 4>;
[[nodiscard]] FourPlaces four_places(const BasisSet& directions, const std::string& encoding);

/// a and v that the lobe takes of each, in tangent space.
[[nodiscard]] std::vector<FourNumbers> numbers_of(Lobe lobe, std::span<const FourBakes> bakes);

/// |v| > 2a: EncodeCounts::over_long.
[[nodiscard]] bool is_over_long(const FourNumbers& numbers);

}  // namespace rnmbake
