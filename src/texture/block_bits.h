// texture/block_bits.h - the bits of a block as a graphics card reads them: BC1, and modes 4, 5 and 6 of BC7.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rnmbake {

/// Two end points (0 to 255, each a value that the format can hold) and which step between them each of the
/// 4 x 4 texels is on, counted from the first.
struct BlockLine {
  std::array<std::array<int, 3>, 2> ends{};
  std::array<int, 16> step{};
};

/// Steps 0 to 3.
[[nodiscard]] std::vector<std::uint8_t> bc1_bits(BlockLine line);

/// Mode 6: 7 bits for a channel and a shared one, which is set; steps 0 to 15; alpha 255.
[[nodiscard]] std::vector<std::uint8_t> bc7_bits(BlockLine line);

/// Bits of a channel's end points and of a step.
struct Bc7LineBits {
  int end = 0, step = 0;
};

/// Mode 5 (7 and 2 bits; 8 and 2 for the one channel) or 4 (5 and 2 or 3; 6 and 3 or 2): channel `alone` is
/// on the line `one`, whose values stand in that channel, too; the others are on `two`; alpha 255.
[[nodiscard]] std::vector<std::uint8_t> bc7_split_bits(BlockLine two, Bc7LineBits two_bits, BlockLine one,
                                                       Bc7LineBits one_bits, std::size_t alone);

}  // namespace rnmbake
