#include "ssbump/map/normals.h"

#include "base/math.h"
#include "encoding/rnm.h"
#include "ssbump/map/weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace rnmbake {
namespace {

void store(const Vec3& v, std::span<float> texel) {
  std::ranges::copy(std::array{v.x, v.y, v.z}, texel.begin());
}

}  // namespace

FloatImage height_normals(const HeightField& field, int begin, int end) {
  FloatImage normals(field.width(), end - begin, 3);
  const auto height = [&](int x, int y) { return field.heights.texel(x, y)[0]; };
  for (int y = begin; y < end; ++y) {
    const int above = texel_beyond(y - 1, field.height(), field.y),
              below = texel_beyond(y + 1, field.height(), field.y);
    for (int x = 0; x < field.width(); ++x) {
      const int left = texel_beyond(x - 1, field.width(), field.x),
                right = texel_beyond(x + 1, field.width(), field.x);
      const Vec3 slope((height(left, y) - height(right, y)) / 2, (height(x, below) - height(x, above)) / 2,
                       1);
      store(unit(slope), normals.texel(x, y - begin));
    }
  }
  return normals;
}

FloatImage bent_normals(const FloatImage& weights) {
  const auto basis = rnm_basis();
  FloatImage normals(weights.width(), weights.height(), 3);
  for (int y = 0; y < weights.height(); ++y) {
    for (int x = 0; x < weights.width(); ++x) {
      const auto w = weights.texel(x, y);
      const Vec3 sum = basis[0] * w[0] + basis[1] * w[1] + basis[2] * w[2];
      const float square = sum.dot(sum);
      store(square > 0 && std::isfinite(square) ? unit(sum) : Vec3(0, 0, 1), normals.texel(x, y));
    }
  }
  return normals;
}

FloatImage weights_of_normals(const FloatImage& normals) {
  const float flat = rnm_basis()[0].z;
  FloatImage weights(normals.width(), normals.height(), SsbumpWeights::channels);
  for (int y = 0; y < normals.height(); ++y) {
    for (int x = 0; x < normals.width(); ++x) {
      const auto n = normals.texel(x, y);
      const auto linear = rnm_linear_weights({n[0], n[1], n[2]});
      const auto w = weights.texel(x, y);
      for (std::size_t i = 0; i < 3; ++i) w[i] = linear[i] / flat;
      w[SsbumpWeights::up] = std::max(0.0F, n[2]);
      w[SsbumpWeights::ambient] = 1;
    }
  }
  return weights;
}

void pack_normals(FloatImage& normals, bool y_down) {
  auto& data = normals.data();
  for (std::size_t i = 0; i < data.size(); ++i) {
    const bool flipped = y_down && i % 3 == 1;
    data[i] = 0.5F + 0.5F * (flipped ? -data[i] : data[i]);
  }
}

}  // namespace rnmbake
