#include "texture/block_bits.h"

#include "texture/bit_writer.h"

#include <utility>

namespace rnmbake {
namespace {

void turn(BlockLine& line, int last_step) {
  std::swap(line.ends[0], line.ends[1]);
  for (int& step : line.step) step = last_step - step;
}

/// BC7 leaves out the first texel's highest bit, which must be 0.
void turn_for_bc7(BlockLine& line, int step_bits) {
  if (line.step[0] >> (step_bits - 1) != 0) turn(line, (1 << step_bits) - 1);
}

void put_channel(BitWriter& out, const BlockLine& line, std::size_t channel, int bits) {
  for (const auto& end : line.ends) out.put(end[channel] >> (8 - bits), bits);
}

void put_steps(BitWriter& out, const BlockLine& line, int bits) {
  for (std::size_t i = 0; i < line.step.size(); ++i) out.put(line.step[i], i == 0 ? bits - 1 : bits);
}

int packed_565(const std::array<int, 3>& colour) {
  return colour[0] >> 3 << 11 | colour[1] >> 2 << 5 | colour[2] >> 3;
}

}  // namespace

std::vector<std::uint8_t> bc1_bits(BlockLine line) {
  if (packed_565(line.ends[0]) < packed_565(line.ends[1])) turn(line, 3);
  const bool one_colour =
      packed_565(line.ends[0]) == packed_565(line.ends[1]);  // the steps would mean other things
  static constexpr std::array code{0, 2, 3, 1};              // the ends come first
  BitWriter out(8);
  for (const auto& end : line.ends) out.put(packed_565(end), 16);
  for (const int step : line.step) out.put(one_colour ? 0 : code[static_cast<std::size_t>(step)], 2);
  return out.finish();
}

std::vector<std::uint8_t> bc7_bits(BlockLine line) {
  constexpr int mode = 6, step_bits = 4;
  turn_for_bc7(line, step_bits);
  BitWriter out(16);
  out.put(1 << mode, mode + 1);
  for (std::size_t c = 0; c < 3; ++c) put_channel(out, line, c, 7);
  out.put(127, 7);  // alpha
  out.put(127, 7);
  out.put(3, 2);  // the shared bits
  put_steps(out, line, step_bits);
  return out.finish();
}

std::vector<std::uint8_t> bc7_split_bits(BlockLine two, Bc7LineBits two_bits, BlockLine one,
                                         Bc7LineBits one_bits, std::size_t alone) {
  const int mode = two_bits.end == 7 ? 5 : 4;
  turn_for_bc7(two, two_bits.step);
  turn_for_bc7(one, one_bits.step);
  for (auto& end : two.ends) end[alone] = 255;  // alpha's place, as these two change theirs when read
  BitWriter out(16);
  out.put(1 << mode, mode + 1);
  out.put(static_cast<int>(alone) + 1, 2);
  if (mode == 4) out.put(two_bits.step == 3 ? 1 : 0, 1);
  for (std::size_t c = 0; c < 3; ++c) put_channel(out, two, c, two_bits.end);
  put_channel(out, one, alone, one_bits.end);
  const bool two_first =
      mode == 5 || two_bits.step == 2;  // mode 4 has the steps of two bits before those of three
  put_steps(out, two_first ? two : one, two_first ? two_bits.step : one_bits.step);
  put_steps(out, two_first ? one : two, two_first ? one_bits.step : two_bits.step);
  return out.finish();
}

}  // namespace rnmbake
