#include "pipeline/convert/frame_rows.h"

#include <cstdlib>
#include <limits>

namespace rnmbake {

void FrameRows::add(int first, const LayeredImage& rows) {
  Band band{first, {}, {}};
  if (const Layer* tangent = rows.find("tangent")) band.tangent = tangent->pixels;
  if (const Layer* normal = rows.find("normal")) band.normal = normal->pixels;
  bands_.push_back(std::move(band));
}

void FrameRows::drop_above(int row) {
  while (!bands_.empty() && bands_.front().first + bands_.front().normal.height() + reach <= row)
    bands_.pop_front();
}

std::optional<TexelFrame> FrameRows::at(int x, int y) const {
  for (const Band& band : bands_) {
    const FloatImage& normal = band.normal;
    if (x < 0 || x >= normal.width() || y < band.first || y >= band.first + normal.height()) continue;
    return frame_at(band.tangent, normal, x, y - band.first, green_);
  }
  return std::nullopt;
}

std::optional<TexelFrame> FrameRows::nearest(int x, int y) const {
  if (auto own = at(x, y)) return own;
  std::optional<TexelFrame> best;
  int best_square = std::numeric_limits<int>::max();
  for (int ring = 1; ring <= reach && ring * ring < best_square; ++ring) {
    for (int dy = -ring; dy <= ring; ++dy) {
      const int step = std::abs(dy) == ring ? 1 : 2 * ring;
      for (int dx = -ring; dx <= ring; dx += step) {
        const int square = dx * dx + dy * dy;
        if (square >= best_square) continue;
        if (auto frame = at(x + dx, y + dy)) {
          best = frame;
          best_square = square;
        }
      }
    }
  }
  return best;
}

}  // namespace rnmbake
