#include "lightmap/half_range.h"

namespace rnmbake {

std::size_t clamp_to_half(FloatImage& image) {
  std::size_t beyond = 0;
  for (float& value : image.data()) beyond += clamp_to_half(value) ? 1 : 0;
  return beyond;
}

}  // namespace rnmbake
