// lightmap/mask_board.h - a page while masks are laid on it.
#pragma once

#include "lightmap/texel_bits.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rnmbake {

/// A mask as runs of texels, those that find a place hardest first.
struct MaskRuns {
  struct Run {
    int row = 0, first = 0, length = 0;
  };
  int width = 0, height = 0;
  std::vector<Run> runs;

  explicit MaskRuns(const TexelBits& mask);
};

/// Texels are counted from the top left.
class MaskBoard {
 public:
  struct Spot {
    int x = 0, y = 0;
  };

  /// A page without masks, which has room for `rows` rows.
  MaskBoard(int width, int rows);

  /// The first place from the top, then from the left, where the mask shares no texel with those before, in
  /// row `from` at the highest; none where it would stand over.
  [[nodiscard]] std::optional<Spot> find(const MaskRuns& mask, int from);

  void put(const MaskRuns& mask, Spot spot);

  /// Rows from the top that hold all masks.
  [[nodiscard]] int used_rows() const { return used_; }

  /// Words of the page that were looked at so far.
  [[nodiscard]] std::uint64_t effort() const { return effort_; }

 private:
  /// Bit x: whether one of the 2^level texels from x on is taken.
  [[nodiscard]] std::uint64_t* taken(int row, int level) {
    return &taken_[(static_cast<std::size_t>(row) * levels_ + level) * stride_];
  }

  /// The first x at which the mask fits into this row and those below; none below 0.
  int first_fit(const MaskRuns& mask, int row);

  /// Blocks the bits x with taken[x + shift]; returns whether all are blocked.
  bool block(const std::uint64_t* taken, int shift);

  int width_, rows_, used_ = 0;
  std::size_t levels_, stride_;
  std::vector<std::uint64_t> taken_;    // [used rows][levels][stride]
  std::vector<std::uint64_t> blocked_;  // of one row, while it is searched
  std::uint64_t effort_ = 0;
};

}  // namespace rnmbake
