#include "pipeline/lightmaps/bounced_light.h"

namespace rnmbake {

void add_light(const Gathered& gathered, float share, TargetBakes& bakes) {
  for (std::size_t k = 0; k < gathered.directions.size(); ++k) {
    const FloatImage& light = gathered.directions[k].radiance;
    FloatImage& sum = bakes.bases[k].radiance;
    for (int y = 0; y < sum.height(); ++y) {
      for (int x = 0; x < sum.width(); ++x) {
        if (bakes.coverage.texel(x, y)[0] > 0)
          set_vec3(sum, x, y, vec3_at(sum, x, y) + vec3_at(light, x, y) * share);
      }
    }
  }
}

}  // namespace rnmbake
