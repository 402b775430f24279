// ssbump/horizon_vector.h - some floats at once, as many as a register of the processor holds.
//
// Everything here is always inlined, so that it is compiled for the instructions that the caller asks for.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

namespace rnmbake {

#define RNM_LANES inline __attribute__((always_inline))

inline constexpr float no_height = -1e30F;  // under which nothing can stand out

namespace vectors {
using Float4 = float __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));
using Float16 = float __attribute__((vector_size(64)));
using Int4 = std::int32_t __attribute__((vector_size(16)));
using Int8 = std::int32_t __attribute__((vector_size(32)));
using Int16 = std::int32_t __attribute__((vector_size(64)));

template <int Width>
struct Of;
template <>
struct Of<4> {
  using Float = Float4;
  using Int = Int4;
};
template <>
struct Of<8> {
  using Float = Float8;
  using Int = Int8;
};
template <>
struct Of<16> {
  using Float = Float16;
  using Int = Int16;
};
}  // namespace vectors

template <int Width>
struct Lanes {
  static constexpr int count = Width;
  using Float = typename vectors::Of<Width>::Float;
  using Int = typename vectors::Of<Width>::Int;

  RNM_LANES static void load(Float& to, const float* from) { std::memcpy(&to, from, sizeof to); }
  RNM_LANES static void store(float* to, const Float& from) { std::memcpy(to, &from, sizeof from); }
  RNM_LANES static void set(Float& to, float value) { to = value - Float{}; }
  RNM_LANES static void set(Int& to, std::int32_t value) { to = value - Int{}; }
  RNM_LANES static void keep_larger(Float& to, const Float& other) { to = to > other ? to : other; }

  /// 1 / sqrt(x) for x > 0 to about 1e-6 (a guess from the bits, then Newton); something finite for 0.
  RNM_LANES static void inverse_root(Float& to, const Float& x) {
    Int bits;
    std::memcpy(&bits, &x, sizeof bits);
    bits = 0x5f375a86 - (bits >> 1);
    Float y;
    std::memcpy(&y, &bits, sizeof y);
    const Float half = x * 0.5F;
    y = y * (1.5F - half * y * y);
    y = y * (1.5F - half * y * y);
    to = y * (1.5F - half * y * y);
  }

  /// Is any of the lanes (each 0 or -1) set?
  RNM_LANES static bool any(const Int& mask) {
    if constexpr (Width > 4) {
      typename Lanes<Width / 2>::Int low, high;
      halves(low, high, mask);
      return Lanes<Width / 2>::any(low | high);
    } else {
      std::array<std::uint64_t, Width / 2> words;
      std::memcpy(words.data(), &mask, sizeof mask);
      return (words[0] | words[1]) != 0;
    }
  }
  /// Is any lane not above the limit? Comparisons are kept within selections: compilers take them apart
  /// lane by lane where they stand alone.
  RNM_LANES static bool any_not_above(const Float& value, float limit) {
    Int one, zero{};
    set(one, -1);
    Float bound;
    set(bound, limit);
    const Int mask = value > bound ? zero : one;
    return any(mask);
  }
  RNM_LANES static bool any_above(const Float& value, const Float& other) {
    Int one, zero{};
    set(one, -1);
    const Int mask = value > other ? one : zero;
    return any(mask);
  }
  RNM_LANES static std::int32_t smallest(const Int& of) {
    if constexpr (Width > 4) {
      typename Lanes<Width / 2>::Int low, high;
      halves(low, high, of);
      return Lanes<Width / 2>::smallest(low < high ? low : high);
    } else {
      const std::int32_t a = of[0] < of[1] ? of[0] : of[1], b = of[2] < of[3] ? of[2] : of[3];
      return a < b ? a : b;
    }
  }
  RNM_LANES static std::int32_t largest(const Int& of) { return -smallest(-of); }

 private:
  template <typename Half>
  RNM_LANES static void halves(Half& low, Half& high, const Int& of) {
    std::memcpy(&low, &of, sizeof low);
    std::memcpy(&high, reinterpret_cast<const char*>(&of) + sizeof low, sizeof high);
  }
};

}  // namespace rnmbake
