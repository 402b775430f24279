#include "lightmap/half_errors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rnmbake {
namespace {

constexpr int reach = 2;  // texels

/// RGB variances of the mean of two halves.
FloatImage variances(const FloatImage& a, const FloatImage& b, double factor) {
  FloatImage result(a.width(), a.height(), 3);
  for (std::size_t i = 0; i < result.data().size(); ++i) {
    const double difference = double(a.data()[i]) - b.data()[i];
    result.data()[i] = float(factor * difference * difference);
  }
  return result;
}

/// Mean over the covered texels within reach.
FloatImage pooled(const FloatImage& variance, const FloatImage& coverage) {
  const int width = variance.width(), height = variance.height();
  FloatImage result(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (coverage.texel(x, y)[0] <= 0) continue;
      Vec3d sum(0, 0, 0);
      int count = 0;
      for (int v = std::max(y - reach, 0); v <= std::min(y + reach, height - 1); ++v) {
        for (int u = std::max(x - reach, 0); u <= std::min(x + reach, width - 1); ++u) {
          if (coverage.texel(u, v)[0] <= 0) continue;
          sum += Vec3d(vec3_at(variance, u, v));
          ++count;
        }
      }
      set_vec3(result, x, y,
               Vec3(float(std::sqrt(sum.x / count)), float(std::sqrt(sum.y / count)),
                    float(std::sqrt(sum.z / count))));
    }
  }
  return result;
}

double relative(const FloatImage& variance, const FloatImage& a, const FloatImage& b,
                const FloatImage& coverage) {
  double squares = 0, values = 0;
  std::size_t count = 0;
  for (int y = 0; y < variance.height(); ++y) {
    for (int x = 0; x < variance.width(); ++x) {
      if (coverage.texel(x, y)[0] <= 0) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        squares += variance.texel(x, y)[c];
        values += 0.5 * (double(a.texel(x, y)[c]) + b.texel(x, y)[c]);
        ++count;
      }
    }
  }
  return values > 0 ? std::sqrt(squares / double(count)) / (values / double(count)) : 0;
}

}  // namespace

HalfErrors half_errors(const TargetBakes& a, const TargetBakes& b, double variance_factor) {
  HalfErrors errors;
  for (std::size_t i = 0; i < a.bases.size(); ++i) {
    const FloatImage &one = a.bases[i].radiance, &other = b.bases[i].radiance;
    const FloatImage variance = variances(one, other, variance_factor);
    errors.relative = std::max(errors.relative, relative(variance, one, other, a.coverage));
    errors.layers.push_back({a.bases[i].name, pooled(variance, a.coverage)});
  }
  return errors;
}

}  // namespace rnmbake
