// pipeline/convert/frame_rows.h - tangent frames of the rows at hand, and of those around them for texels
// that have none.
#pragma once

#include "lightmap/frames.h"

#include <deque>
#include <optional>

namespace rnmbake {

/// Bands of rows in the order of the file; only those that a search may reach are kept.
class FrameRows {
 public:
  static constexpr int reach = 8;  // texels around one without a frame, as dilation leaves them

  explicit FrameRows(Green green) : green_(green) {}

  /// The next band; `first` is the number of its first row.
  void add(int first, const LayeredImage& rows);

  /// Drops bands that end more than `reach` rows above `row`.
  void drop_above(int row);

  /// The texel's own frame, or the nearest one within `reach`; the first in reading order of equals.
  [[nodiscard]] std::optional<TexelFrame> nearest(int x, int y) const;

 private:
  struct Band {
    int first = 0;
    FloatImage tangent, normal;
  };
  [[nodiscard]] std::optional<TexelFrame> at(int x, int y) const;

  Green green_;
  std::deque<Band> bands_;
};

}  // namespace rnmbake
