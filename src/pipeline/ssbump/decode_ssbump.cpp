#include "pipeline/ssbump/decode_ssbump.h"

#include "base/math.h"
#include "image/sample.h"
#include "ssbump/map/weights.h"

#include <algorithm>
#include <array>
#include <utility>

namespace rnmbake {
namespace {

/// Minimum over the three maps, for each colour channel.
Vec3 least(const std::array<Vec3, 3>& maps) {
  const auto of = [&](int c) { return std::min({maps[0][c], maps[1][c], maps[2][c]}); };
  return {of(0), of(1), of(2)};
}

}  // namespace

FloatImage decode_ssbump(Lightmap lightmap, const SsbumpPicture& ssbump, DecodeVariant variant) {
  const bool has_up = ssbump.metadata.alpha == SsbumpAlpha::up;
  const LightmapDecoder decoder(std::move(lightmap), variant);
  // Weights are right-handed; a lightmap with y down has its axes mirrored.
  const bool mirrored = decoder.metadata().green == Green::y_down;
  const std::size_t upper = mirrored ? 2 : 1, lower = mirrored ? 1 : 2;
  const FloatImage& weights = ssbump.weights;
  FloatImage result(weights.width(), weights.height(), 3);
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x) {
      const auto w = weights.texel(x, y);
      const auto maps = decoder.rnm_at(texel_uv(result, x, y));
      const Vec3 above = has_up ? least(maps) : Vec3(0);
      const Vec3 three =
          (maps[0] - above) * w[0] + (maps[1] - above) * w[upper] + (maps[2] - above) * w[lower];
      set_vec3(result, x, y, three / 3 + above * w[SsbumpWeights::up]);
    }
  }
  return result;
}

}  // namespace rnmbake
