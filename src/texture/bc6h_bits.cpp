#include "texture/bc6h_bits.h"

#include "texture/bit_writer.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace rnmbake {
namespace {

constexpr int mode_bits = 5, step_bits = 4, last_step = 15, low_bits = 10;
constexpr std::array weights{0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};  // 64ths

class BitReader {
 public:
  explicit BitReader(std::span<const std::uint8_t, bc6h_block_bytes> bytes) : bytes_(bytes) {}

  [[nodiscard]] int take(int bits) {
    int value = 0;
    for (int bit = 0; bit < bits; ++bit) value |= take_bit() << bit;
    return value;
  }
  [[nodiscard]] int take_bit() {
    const int bit = bytes_[at_ / 8] >> at_ % 8 & 1;
    ++at_;
    return bit;
  }

 private:
  std::span<const std::uint8_t, bc6h_block_bytes> bytes_;
  std::size_t at_ = 0;
};

int with_sign(int value, int bits) {
  return (value & 1 << (bits - 1)) != 0 ? value - (1 << bits) : value;
}

bool has_difference(const Bc6hMode& mode) {
  return mode.difference_bits < mode.end_bits;
}

}  // namespace

const std::array<Bc6hMode, 4>& bc6h_modes() {
  static constexpr std::array<Bc6hMode, 4> modes{{{3, 10, 10}, {7, 11, 9}, {11, 12, 8}, {15, 16, 4}}};
  return modes;
}

bool fits(const Bc6hMode& mode, const Bc6hLine& line) {
  if (!has_difference(mode)) return true;
  for (std::size_t c = 0; c < 3; ++c)
    if (std::abs(line.ends[1][c] - line.ends[0][c]) >= 1 << (mode.difference_bits - 1)) return false;
  return true;
}

std::vector<std::uint8_t> bc6h_bits(const Bc6hMode& mode, Bc6hLine line) {
  if (line.step[0] > last_step / 2) {  // its highest bit is left out
    std::swap(line.ends[0], line.ends[1]);
    for (int& step : line.step) step = last_step - step;
  }
  BitWriter out(bc6h_block_bytes);
  out.put(mode.code, mode_bits);
  for (const int end : line.ends[0]) out.put(end, low_bits);
  for (std::size_t c = 0; c < 3; ++c) {
    const int first = line.ends[0][c], second = line.ends[1][c];
    out.put(has_difference(mode) ? second - first : second, mode.difference_bits);
    for (int bit = mode.end_bits - 1; bit >= low_bits; --bit) out.put_bit(first, bit);  // the highest first
  }
  for (std::size_t i = 0; i < line.step.size(); ++i)
    out.put(line.step[i], i == 0 ? step_bits - 1 : step_bits);
  return out.finish();
}

int bc6h_widened(int end, int bits, bool is_signed) {
  if (bits >= 16) return end;
  if (!is_signed) {
    if (end == 0) return 0;
    return end == (1 << bits) - 1 ? 0xFFFF : ((end << 16) + 0x8000) >> bits;
  }
  const int magnitude = std::abs(end);
  int wide = 0;
  if (magnitude >= (1 << (bits - 1)) - 1) {
    wide = 0x7FFF;
  } else if (magnitude > 0) {
    wide = ((magnitude << 15) + 0x4000) >> (bits - 1);
  }
  return end < 0 ? -wide : wide;
}

std::uint16_t bc6h_half(int first, int second, std::size_t step, bool is_signed) {
  const int between = (first * (64 - weights[step]) + second * weights[step] + 32) >> 6;
  if (!is_signed) return static_cast<std::uint16_t>(between * 31 >> 6);
  const int magnitude = std::abs(between) * 31 >> 5;
  return static_cast<std::uint16_t>(between < 0 ? 0x8000 | magnitude : magnitude);
}

std::array<std::uint16_t, 48> bc6h_halves(std::span<const std::uint8_t, bc6h_block_bytes> block,
                                          bool is_signed) {
  BitReader in(block);
  const auto* mode = std::ranges::find(bc6h_modes(), in.take(mode_bits), &Bc6hMode::code);
  if (mode == bc6h_modes().end())
    throw std::invalid_argument("a BC6H block of two lines, or of no known mode");
  std::array<std::array<int, 3>, 2> wide{};
  std::array<int, 3> low{};
  for (int& end : low) end = in.take(low_bits);
  for (std::size_t c = 0; c < 3; ++c) {
    int second = in.take(mode->difference_bits), first = low[c];
    for (int bit = mode->end_bits - 1; bit >= low_bits; --bit) first |= in.take_bit() << bit;
    if (has_difference(*mode))
      second = (first + with_sign(second, mode->difference_bits)) & ((1 << mode->end_bits) - 1);
    if (is_signed) {
      first = with_sign(first, mode->end_bits);
      second = with_sign(second, mode->end_bits);
    }
    wide[0][c] = bc6h_widened(first, mode->end_bits, is_signed);
    wide[1][c] = bc6h_widened(second, mode->end_bits, is_signed);
  }
  std::array<std::uint16_t, 48> halves{};
  for (std::size_t i = 0; i < 16; ++i) {
    const auto step = static_cast<std::size_t>(in.take(i == 0 ? step_bits - 1 : step_bits));
    for (std::size_t c = 0; c < 3; ++c)
      halves[3 * i + c] = bc6h_half(wide[0][c], wide[1][c], step, is_signed);
  }
  return halves;
}

}  // namespace rnmbake
