// sampling/sampler.h - low-discrepancy numbers: Owen-scrambled Sobol pairs, a fresh shuffle for each pair.
#pragma once

#include "base/math.h"
#include "sampling/splitmix64.h"

#include <array>
#include <cstdint>

namespace rnmbake {

/// Second dimension of Sobol's sequence for the low and the high byte of an index: they add by exclusive or.
inline constexpr auto sobol_bytes = [] {
  std::array<std::array<std::uint32_t, 256>, 2> table{};
  for (std::uint32_t index = 0; index < 256; ++index) {
    std::uint32_t v = 1U << 31;
    for (std::uint32_t bit = 0; bit < 16; ++bit, v ^= v >> 1) {
      if ((index >> (bit & 7U) & 1U) != 0) table[bit >> 3][index] ^= v;
    }
  }
  return table;
}();

/// Sample `index` (below 65536) of a sequence; each call takes the next dimensions. Pairs are
/// (0,2)-sequences, scrambled by hashing as in Burley, "Practical Hash-based Owen Scrambling" (JCGT 2020),
/// and padded: each pair permutes the sequence in its own way. Another seed is an independent randomisation.
class Sampler {
 public:
  Sampler(std::uint64_t seed, std::uint32_t index) : seed_(seed), index_(index) {}

  /// In [0, 1).
  [[nodiscard]] float next1() { return next2().x; }
  [[nodiscard]] Vec2 next2() {
    const std::uint64_t hash = hash_of(seed_, dimension_++);
    const auto low = static_cast<std::uint32_t>(hash), high = static_cast<std::uint32_t>(hash >> 32);
    const std::uint32_t i = scramble(index_ << 16, low) >> 16;
    return {unit(scramble_reversed(i, high)), unit(scramble(sobol(i), low * 0x9e3779b9U + high))};
  }
  [[nodiscard]] Vec3 next3() {
    const float x = next1();
    const Vec2 yz = next2();
    return {x, yz.x, yz.y};
  }

 private:
  static std::uint32_t reverse(std::uint32_t x) {
    x = __builtin_bswap32(x);
    x = ((x & 0x0f0f0f0fU) << 4) | ((x >> 4) & 0x0f0f0f0fU);
    x = ((x & 0x33333333U) << 2) | ((x >> 2) & 0x33333333U);
    return ((x & 0x55555555U) << 1) | ((x >> 1) & 0x55555555U);
  }
  /// Flips each bit depending on the lower ones alone (Laine and Karras 2011).
  static std::uint32_t permute(std::uint32_t x, std::uint32_t seed) {
    x += seed;
    x ^= x * 0x6c50b47cU;
    x ^= x * 0xb82f1e52U;
    x ^= x * 0xc7afe638U;
    x ^= x * 0x8d22f6e6U;
    return x;
  }
  /// Owen's scramble of a binary fraction; scramble_reversed() takes it with its bits reversed.
  static std::uint32_t scramble_reversed(std::uint32_t x, std::uint32_t seed) {
    return reverse(permute(x, seed));
  }
  static std::uint32_t scramble(std::uint32_t x, std::uint32_t seed) {
    return scramble_reversed(reverse(x), seed);
  }

  /// Second dimension of Sobol's sequence; the first is the reversed index.
  static std::uint32_t sobol(std::uint32_t index) {
    return sobol_bytes[0][index & 255U] ^ sobol_bytes[1][(index >> 8) & 255U];
  }
  static float unit(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24F; }

  std::uint64_t seed_;
  std::uint32_t index_;
  std::uint32_t dimension_ = 0;
};

}  // namespace rnmbake
