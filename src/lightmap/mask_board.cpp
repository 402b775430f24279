#include "lightmap/mask_board.h"

#include <algorithm>
#include <bit>
#include <tuple>

namespace rnmbake {
namespace {

constexpr std::uint64_t all_bits = ~std::uint64_t{0};

/// Of the longest runs of 2^level texels within `length`.
int level_of(int length) {
  return std::bit_width(static_cast<unsigned>(length)) - 1;
}

/// Numbers 0 to 15 so that neighbours are far apart.
int scattered(int row) {
  return (row & 1) << 3 | (row & 2) << 1 | (row & 4) >> 1 | (row & 8) >> 3;
}

}  // namespace

MaskRuns::MaskRuns(const TexelBits& mask) : width(mask.width()), height(mask.height()) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!mask.at(x, y)) continue;
      const int first = x;
      while (x < width && mask.at(x, y)) ++x;
      runs.push_back({y, first, x - first});
    }
  }
  // Neighbouring rows are alike, and where one finds no place, the next does not either.
  std::ranges::stable_sort(runs, [](const Run& a, const Run& b) {
    return std::tuple(-level_of(a.length), scattered(a.row % 16)) <
           std::tuple(-level_of(b.length), scattered(b.row % 16));
  });
}

MaskBoard::MaskBoard(int width, int rows)
    : width_(width),
      rows_(rows),
      levels_(static_cast<std::size_t>(level_of(width)) + 1),
      stride_((static_cast<std::size_t>(width) + 63) / 64 + 1) {}

std::optional<MaskBoard::Spot> MaskBoard::find(const MaskRuns& mask, int from) {
  if (mask.width > width_) return {};
  for (int y = from; y + mask.height <= rows_; ++y) {
    const int x = first_fit(mask, y);
    if (x >= 0) return Spot{x, y};
  }
  return {};
}

int MaskBoard::first_fit(const MaskRuns& mask, int row) {
  const int places = width_ - mask.width + 1;
  blocked_.assign((static_cast<std::size_t>(places) + 63) / 64, 0);
  if (places % 64 != 0) blocked_.back() = all_bits << (places % 64);
  for (const MaskRuns::Run& run : mask.runs) {
    if (row + run.row >= used_) continue;
    const int level = level_of(run.length), rest = run.length - (1 << level);
    const std::uint64_t* const bits = taken(row + run.row, level);
    if (block(bits, run.first)) return -1;
    if (rest > 0 && block(bits, run.first + rest)) return -1;
  }
  for (std::size_t i = 0; i < blocked_.size(); ++i)
    if (blocked_[i] != all_bits) return static_cast<int>(64 * i) + std::countr_one(blocked_[i]);
  return -1;
}

bool MaskBoard::block(const std::uint64_t* taken, int shift) {
  taken += shift / 64;
  const int right = shift % 64;
  const std::size_t words = blocked_.size();
  effort_ += words;
  std::uint64_t common = all_bits;
  if (right == 0) {
    for (std::size_t i = 0; i < words; ++i) common &= blocked_[i] |= taken[i];
  } else {
    for (std::size_t i = 0; i < words; ++i)
      common &= blocked_[i] |= taken[i] >> right | taken[i + 1] << (64 - right);
  }
  return common == all_bits;
}

void MaskBoard::put(const MaskRuns& mask, Spot spot) {
  if (spot.y + mask.height > used_) {
    used_ = spot.y + mask.height;
    taken_.resize(static_cast<std::size_t>(used_) * levels_ * stride_);
  }
  for (const MaskRuns::Run& run : mask.runs) {
    std::uint64_t* const bits = taken(spot.y + run.row, 0);
    for (int x = spot.x + run.first; x < spot.x + run.first + run.length; ++x)
      bits[x / 64] |= std::uint64_t{1} << (x % 64);
  }
  for (int y = spot.y; y < spot.y + mask.height; ++y) {
    for (std::size_t level = 1; level < levels_; ++level) {
      const std::uint64_t* const finer = taken(y, static_cast<int>(level) - 1);
      std::uint64_t* const bits = taken(y, static_cast<int>(level));
      const std::size_t shift = std::size_t{1} << (level - 1), whole = shift / 64, part = shift % 64;
      for (std::size_t i = 0; i < stride_; ++i) {
        const std::uint64_t low = i + whole < stride_ ? finer[i + whole] : 0;
        const std::uint64_t high = i + whole + 1 < stride_ ? finer[i + whole + 1] : 0;
        bits[i] = finer[i] | (part == 0 ? low : low >> part | high << (64 - part));
      }
    }
  }
}

}  // namespace rnmbake
