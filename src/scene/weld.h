// scene/weld.h - gives things with equal keys the same number.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace rnmbake {

/// -0 and 0 are the same place.
inline std::uint32_t weld_bits(float value) {
  return std::bit_cast<std::uint32_t>(value == 0.0F ? 0.0F : value);
}

template <std::size_t N>
struct WeldHash {
  std::size_t operator()(const std::array<std::uint32_t, N>& key) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t word : key) {
      hash = (hash ^ word) * 0x9e3779b97f4a7c15ULL;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

/// key(i) -> std::array<std::uint32_t, N>. Numbers count up from 0 in the order of first appearance.
template <std::size_t N, typename Key>
std::vector<std::uint32_t> weld(std::size_t count, const Key& key) {
  std::unordered_map<std::array<std::uint32_t, N>, std::uint32_t, WeldHash<N>> numbers;
  numbers.reserve(count);
  std::vector<std::uint32_t> result(count);
  for (std::size_t i = 0; i < count; ++i) {
    result[i] = numbers.try_emplace(key(i), static_cast<std::uint32_t>(numbers.size())).first->second;
  }
  return result;
}

}  // namespace rnmbake
