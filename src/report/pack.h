// report/pack.h - pictures as text that a page unpacks when it shows them (src/report/html/data.js).
#pragma once

#include "image/float_image.h"

#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

/// A picture of one or three channels; `kept_bits` of a half float's 10 bits of mantissa are kept.
struct PackedPicture {
  const FloatImage* image = nullptr;
  int kept_bits = 10;
};

/// Half floats, one plane for each channel, the low bytes before the high ones. The second and third channel
/// are differences of bit patterns to the first, which for light of one colour are nearly constant. All
/// planes together are compressed (zlib) and written in base64.
[[nodiscard]] std::string pack(const std::vector<PackedPicture>& pictures);

[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace rnmbake
