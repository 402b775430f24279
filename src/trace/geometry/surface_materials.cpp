#include "trace/geometry/surface_materials.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

/// The two texels that a bilinear lookup filters along an axis, and the share of the second.
struct Taps {
  int first = 0, second = 0;
  float share = 0;
};

Taps taps(float texel, int count) {
  const auto last = static_cast<float>(count - 1);
  const float clamped = texel > 0 ? std::min(texel, last) : 0.0F;  // NaN: 0
  const int first = static_cast<int>(clamped);
  return {first, std::min(first + 1, count - 1), clamped - static_cast<float>(first)};
}

}  // namespace

Vec3 lookup(const Texture& picture, const Vec2& uv) {
  const Taps x = taps(uv.x * static_cast<float>(picture.width) - 0.5F, picture.width);
  const Taps y = taps((1 - uv.y) * static_cast<float>(picture.height) - 0.5F, picture.height);
  const auto row = [&](int line) {
    const Vec3* texels = &picture.texels[static_cast<std::size_t>(line) * picture.width];
    return texels[x.first] * (1 - x.share) + texels[x.second] * x.share;
  };
  return row(y.first) * (1 - y.share) + row(y.second) * y.share;
}

}  // namespace rnmbake
