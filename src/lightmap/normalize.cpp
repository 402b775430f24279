#include "lightmap/normalize.h"

#include "encoding/rnm.h"

#include <cmath>

namespace rnmbake {

std::size_t normalize_to_flat(const std::array<FloatImage*, 3>& maps, const FloatImage& flat) {
  std::size_t unscalable = 0;
  for (std::size_t i = 0; i < flat.data().size(); ++i) {
    const std::array<float, 3> values{maps[0]->data()[i], maps[1]->data()[i], maps[2]->data()[i]};
    const float sum = values[0] + values[1] + values[2];
    if (!std::isfinite(sum) || !std::isfinite(flat.data()[i])) continue;
    if (!(sum > 0) && flat.data()[i] > 0) ++unscalable;
    const auto scaled = rnm_scaled_to_flat(values, flat.data()[i]);
    for (std::size_t map = 0; map < 3; ++map) maps[map]->data()[i] = scaled[map];
  }
  return unscalable;
}

}  // namespace rnmbake
