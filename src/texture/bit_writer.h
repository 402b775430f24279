// texture/bit_writer.h - the bits of a block, one number behind the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace rnmbake {

/// Each number from its lowest bit on.
class BitWriter {
 public:
  explicit BitWriter(std::size_t bytes) : bytes_(bytes) {}

  void put(int value, int bits) {
    for (int bit = 0; bit < bits; ++bit) put_bit(value, bit);
  }
  /// One bit of a number.
  void put_bit(int value, int bit) {
    bytes_[at_ / 8] = static_cast<std::uint8_t>(bytes_[at_ / 8] | ((value >> bit & 1) << at_ % 8));
    ++at_;
  }
  std::vector<std::uint8_t> finish() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

}  // namespace rnmbake
