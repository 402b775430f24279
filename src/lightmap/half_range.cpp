#include "lightmap/half_range.h"

#include <cmath>

namespace rnmbake {

std::size_t clamp_to_half(FloatImage& image) {
  std::size_t beyond = 0;
  for (float& value : image.data()) {
    if (!std::isfinite(value) || std::abs(value) <= largest_half) continue;
    value = std::copysign(largest_half, value);
    ++beyond;
  }
  return beyond;
}

}  // namespace rnmbake
