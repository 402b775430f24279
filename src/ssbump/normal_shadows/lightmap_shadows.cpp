#include "ssbump/normal_shadows/lightmap_shadows.h"

#include "encoding/dominant_direction.h"

#include <cstddef>

#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

LinearLight light_at(const BakedLight& baked, const Vec2& uv) {
  auto taps = bilinear_taps(baked.flat, uv, Border::clamp);
  if (!baked.coverage.empty()) taps = covered_taps(taps, baked.coverage);
  std::array<float, 3> flat{};
  std::array<std::array<float, 3>, 3> rnm{};
  sample(baked.flat, taps, flat);
  for (std::size_t i = 0; i < 3; ++i) sample(baked.rnm[i], taps, rnm[i]);
  LinearLight light = fit_linear(flat, rnm);
  if (baked.y_down)
    for (Vec3& gradient : light.gradient) gradient.y = -gradient.y;
  return light;
}

}  // namespace

FloatImage lightmap_shadows(const FloatImage& normals, const BakedLight& baked, const Repeat& repeat,
                            const NormalShadowOptions& options) {
  FloatImage result(normals.width() * repeat.u, normals.height() * repeat.v, 3);
  tbb::parallel_for(0, result.height(), [&](int y) {
    for (int x = 0; x < result.width(); ++x) {
      const LinearLight light = light_at(baked, texel_uv(result, x, y));
      const int map_x = x % normals.width(), map_y = y % normals.height();
      const auto n = normals.texel(map_x, map_y);
      const Vec3 normal(n[0], n[1], n[2]);
      const auto direction = dominant_direction(light);
      const float left = direction ? light_left(normals, map_x, map_y, *direction, options) : 1;
      const auto out = result.texel(x, y);
      for (std::size_t c = 0; c < 3; ++c)
        out[c] = shadowed(light, c, direction.value_or(Vec3(0, 0, 1)), normal, left);
    }
  });
  return result;
}

}  // namespace rnmbake
