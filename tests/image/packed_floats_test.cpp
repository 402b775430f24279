#include "image/packed_floats.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// The specification's words in C: 5 bits of exponent, biased by 15.
double float_of(std::uint32_t bits, int mantissa_bits) {
  const int exponent = int(bits >> mantissa_bits), mantissa = int(bits & ((1U << mantissa_bits) - 1));
  if (exponent == 0) return std::ldexp(mantissa, -14 - mantissa_bits);
  return std::ldexp(mantissa + (1 << mantissa_bits), exponent - 15 - mantissa_bits);
}

TEST(B10G11R11, IsWhatItsSpecificationSays) {
  for (std::uint32_t bits = 0; bits < 31U << 6U; ++bits) {
    EXPECT_EQ(unpack_b10g11r11(bits).x, float_of(bits, 6));
    EXPECT_EQ(unpack_b10g11r11(bits << 11U).y, float_of(bits, 6));
    EXPECT_EQ(unpack_b10g11r11(bits >> 1U << 22U).z, float_of(bits >> 1U, 5));
    EXPECT_EQ(pack_b10g11r11(unpack_b10g11r11(bits)), bits);
  }
}

TEST(B10G11R11, RoundsToTheNearest) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-10, 15);
  for (int i = 0; i < 10000; ++i) {
    const float value = std::exp2(exponent(random));
    const Vec3 seen = unpack_b10g11r11(pack_b10g11r11({value, value, value}));
    EXPECT_NEAR(seen.x, value, value / 128 + value / 2048);  // by way of halves
    EXPECT_NEAR(seen.z, value, value / 64 + value / 2048);
  }
}

TEST(B10G11R11, ClampsWhatItCannotHold) {
  const float infinite = std::numeric_limits<float>::infinity();
  EXPECT_EQ(unpack_b10g11r11(pack_b10g11r11({infinite, -1, 1e9F})), Vec3(65024, 0, 64512));
  EXPECT_EQ(pack_b10g11r11({std::nanf(""), 0, 0}), 0U);
}

TEST(E5B9G9R9, IsWhatItsSpecificationSays) {
  EXPECT_EQ(unpack_e5b9g9r9(16U << 27U | 256U), Vec3(1, 0, 0));
  EXPECT_EQ(unpack_e5b9g9r9(15U << 27U | 1U << 9U), Vec3(0, 1.0F / 512, 0));
  EXPECT_EQ(unpack_e5b9g9r9(31U << 27U | 511U << 18U), Vec3(0, 0, 65408));
}

TEST(E5B9G9R9, RoundsToTheNearest) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-10, 15);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 colour{std::exp2(exponent(random)), std::exp2(exponent(random)), std::exp2(exponent(random))};
    const Vec3 seen = unpack_e5b9g9r9(pack_e5b9g9r9(colour));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], colour[c], max_channel(colour) / 512 * 1.001F);
  }
}

/// Half floats, which lightmaps have, are often in the middle between two.
TEST(PackedFloats, KeepTheMeanOfHalves) {
  double sum = 0, packed = 0, shared = 0;
  for (int i = 1024; i < 2048; ++i) {
    const float value = static_cast<float>(i) / 1024;
    sum += double(value);
    packed += double(unpack_b10g11r11(pack_b10g11r11({value, 0, 0})).x);
    shared += double(unpack_e5b9g9r9(pack_e5b9g9r9({value, 0, 0})).x);
  }
  EXPECT_NEAR(packed / sum, 1, 1e-5);
  EXPECT_NEAR(shared / sum, 1, 1e-5);
}

TEST(E5B9G9R9, CarriesIntoTheExponent) {
  EXPECT_EQ(unpack_e5b9g9r9(pack_e5b9g9r9({1.9999F, 0, 0})), Vec3(2, 0, 0));
}

TEST(E5B9G9R9, ClampsWhatItCannotHold) {
  EXPECT_EQ(unpack_e5b9g9r9(pack_e5b9g9r9({1e9F, -1, std::nanf("")})), Vec3(65408, 0, 0));
  EXPECT_EQ(pack_e5b9g9r9({0, 0, 0}), 0U);
}

}  // namespace
}  // namespace rnmbake
