#include "image/packed_floats.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <half.h>

namespace rnmbake {
namespace {

/// A half float without its sign and lowest bits.
std::uint32_t shortened(float value, unsigned dropped) {
  const auto bits = static_cast<std::uint32_t>(half(std::min(std::max(0.0F, value), 65504.0F)).bits());
  const std::uint32_t most = 0x7BFFU >> dropped;      // infinity is the next one
  const std::uint32_t is_odd = bits >> dropped & 1U;  // ties go to the even one, or means would rise
  return std::min((bits + (1U << (dropped - 1)) - 1 + is_odd) >> dropped, most);
}

float lengthened(std::uint32_t bits, unsigned dropped) {
  half value;
  value.setBits(static_cast<std::uint16_t>(bits << dropped));
  return value;
}

constexpr int exponent_bias = 15, mantissa_bits = 9;
constexpr float mantissas = 512;

}  // namespace

std::uint32_t pack_b10g11r11(const Vec3& colour) {
  return shortened(colour.x, 4) | shortened(colour.y, 4) << 11U | shortened(colour.z, 5) << 22U;
}

Vec3 unpack_b10g11r11(std::uint32_t bits) {
  return {lengthened(bits & 0x7FFU, 4), lengthened(bits >> 11U & 0x7FFU, 4), lengthened(bits >> 22U, 5)};
}

std::uint32_t pack_e5b9g9r9(const Vec3& colour) {
  constexpr float largest = 65408;
  std::array<float, 3> values{};
  for (int c = 0; c < 3; ++c)
    values[static_cast<std::size_t>(c)] = std::min(std::max(0.0F, colour[c]), largest);
  const float most = *std::ranges::max_element(values);
  int exponent = most > 0 ? std::max(std::ilogb(most) + 1 + exponent_bias, 0) : 0;
  const auto mantissa = [&](float value) {
    return std::nearbyint(std::ldexp(value, mantissa_bits + exponent_bias - exponent));
  };
  if (mantissa(most) >= mantissas) ++exponent;
  std::uint32_t bits = static_cast<std::uint32_t>(exponent) << 27U;
  for (std::size_t c = 0; c < 3; ++c) bits |= static_cast<std::uint32_t>(mantissa(values[c])) << 9U * c;
  return bits;
}

Vec3 unpack_e5b9g9r9(std::uint32_t bits) {
  const int exponent = static_cast<int>(bits >> 27U) - exponent_bias - mantissa_bits;
  Vec3 colour;
  for (unsigned c = 0; c < 3; ++c)
    colour[static_cast<int>(c)] = std::ldexp(static_cast<float>(bits >> 9U * c & 511U), exponent);
  return colour;
}

}  // namespace rnmbake
