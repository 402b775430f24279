// texture/bc6h_bits.h - the bits of a BC6H block of one line (modes 11 to 14) as a graphics card reads them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rnmbake {

inline constexpr std::size_t bc6h_block_bytes = 16;

/// A mode of one line: bits of its end points, and of the second one's difference to the first.
struct Bc6hMode {
  int code = 0;                           // its lowest five bits in a block
  int end_bits = 0, difference_bits = 0;  // the same: no difference, the second end stands for itself
};

/// Modes 11 to 14, the finest last.
[[nodiscard]] const std::array<Bc6hMode, 4>& bc6h_modes();

/// Two end points as the format stores them, two's complement where signed, and which of the 16 steps between
/// them each texel is on.
struct Bc6hLine {
  std::array<std::array<int, 3>, 2> ends{};
  std::array<int, 16> step{};
};

/// Whether the second end's difference fits into the mode's bits, either way round.
[[nodiscard]] bool fits(const Bc6hMode& mode, const Bc6hLine& line);

/// The line has to fit. The bits do not say whether they are signed.
[[nodiscard]] std::vector<std::uint8_t> bc6h_bits(const Bc6hMode& mode, Bc6hLine line);

/// An end point widened to 16 bits, unsigned or with a sign.
[[nodiscard]] int bc6h_widened(int end, int bits, bool is_signed);

/// The bits of the half float at one of 16 steps between two widened end points.
[[nodiscard]] std::uint16_t bc6h_half(int first, int second, std::size_t step, bool is_signed);

/// Bits of half floats, three for each texel, row by row. Throws std::invalid_argument where the mode is of
/// two lines, which no block of bc6h_bits() is.
[[nodiscard]] std::array<std::uint16_t, 48> bc6h_halves(std::span<const std::uint8_t, bc6h_block_bytes> block,
                                                        bool is_signed);

}  // namespace rnmbake
