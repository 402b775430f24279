// sampling/splitmix64.h - SplitMix64: a hash of 64 bits, and the pseudo-random sequence made of it.
//
// Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators" (OOPSLA 2014).
#pragma once

#include <cstdint>

namespace rnmbake {

inline constexpr std::uint64_t splitmix64_step = 0x9e3779b97f4a7c15ULL;

/// The finaliser: every bit of the result depends on every bit of `x`.
[[nodiscard]] constexpr std::uint64_t mix64(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Hashes two numbers into one: number `b` of the sequence with seed `a`.
[[nodiscard]] constexpr std::uint64_t hash_of(std::uint64_t a, std::uint64_t b) {
  return mix64(a + splitmix64_step * (b + 1));
}

class SplitMix64 {
 public:
  explicit constexpr SplitMix64(std::uint64_t seed) : state_(seed) {}

  [[nodiscard]] constexpr std::uint64_t next() { return mix64(state_ += splitmix64_step); }
  /// In [0, 1), with 53 random bits.
  [[nodiscard]] constexpr double next_double() { return static_cast<double>(next() >> 11) * 0x1p-53; }

 private:
  std::uint64_t state_;
};

}  // namespace rnmbake
