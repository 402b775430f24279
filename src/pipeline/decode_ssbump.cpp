#include "pipeline/decode_ssbump.h"

#include "base/error.h"
#include "image/sample.h"
#include "ssbump/weights.h"

#include <algorithm>
#include <array>
#include <utility>

namespace rnmbake {

FloatImage decode_ssbump(Lightmap lightmap, const SsbumpPicture& ssbump, DecodeVariant variant) {
  const bool has_up = ssbump.metadata.alpha == SsbumpAlpha::up;
  if (has_up && lightmap.flat.empty()) {
    fail(
        ExitCode::unsupported,
        "the fourth channel of the self-shadowed bump map goes with the flat layer, which this lightmap does "
        "not have; bake flat too");
  }
  const LightmapDecoder decoder(std::move(lightmap), variant);
  // Weights are right-handed; a lightmap with y down has its axes mirrored.
  const bool mirrored = decoder.metadata().green == Green::y_down;
  const std::size_t upper = mirrored ? 2 : 1, lower = mirrored ? 1 : 2;
  const FloatImage& weights = ssbump.weights;
  FloatImage result(weights.width(), weights.height(), 3);
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x) {
      const auto w = weights.texel(x, y);
      const auto [maps, flat] = decoder.maps_at(texel_uv(result, x, y));
      const Vec3 three = maps[0] * w[0] + maps[1] * w[upper] + maps[2] * w[lower];
      const Vec3 lit = has_up ? (three + flat * w[SsbumpWeights::up]) / 4 : three / 3;
      std::ranges::copy(std::array{lit.x, lit.y, lit.z}, result.texel(x, y).begin());
    }
  }
  return result;
}

}  // namespace rnmbake
