// image/packed_floats.h - three values that are not negative in 32 bits, as graphics cards read them.
#pragma once

#include "base/math.h"

#include <cstdint>

namespace rnmbake {

/// B10G11R11: floats without a sign, 5 bits of exponent, 6 of mantissa (blue: 5), red lowest. Rounded to the
/// nearest; negative values and NaN become 0, those beyond the format (65024; blue: 64512) its largest.
[[nodiscard]] std::uint32_t pack_b10g11r11(const Vec3& colour);
[[nodiscard]] Vec3 unpack_b10g11r11(std::uint32_t bits);

/// E5B9G9R9: 9 bits each, red lowest, and an exponent for all three; the same of what it cannot hold (65408).
[[nodiscard]] std::uint32_t pack_e5b9g9r9(const Vec3& colour);
[[nodiscard]] Vec3 unpack_e5b9g9r9(std::uint32_t bits);

}  // namespace rnmbake
