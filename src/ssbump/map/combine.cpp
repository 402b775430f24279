#include "ssbump/map/combine.h"

#include "image/sample.h"
#include "ssbump/map/weights.h"

#include <array>
#include <cstddef>

namespace rnmbake {

void combine_detail(FloatImage& weights, const FloatImage& detail, double repeat, Combine how) {
  std::array<float, SsbumpWeights::channels> factor{};
  const auto times = static_cast<float>(repeat);
  for (int y = 0; y < weights.height(); ++y) {
    for (int x = 0; x < weights.width(); ++x) {
      const Vec2 uv = texel_uv(weights, x, y) * times;
      sample(detail, bilinear_taps(detail, uv, Border::wrap), factor);
      const float mean = (factor[0] + factor[1] + factor[2]) / 3;
      const auto texel = weights.texel(x, y);
      for (std::size_t c = 0; c < SsbumpWeights::ambient; ++c)
        texel[c] *= how == Combine::even ? mean : factor[c];
      texel[SsbumpWeights::ambient] *= factor[SsbumpWeights::ambient];
    }
  }
}

}  // namespace rnmbake
