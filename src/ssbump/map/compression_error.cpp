#include "ssbump/map/compression_error.h"

#include "base/math.h"
#include "encoding/rnm.h"
#include "ssbump/map/normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace rnmbake {
namespace {

/// Means over lights of LM_i LM_j and of LM_i.
struct Lights {
  std::array<std::array<double, 3>, 3> square{};
  std::array<double, 3> mean{};
};

/// Directions evenly over the hemisphere: Fibonacci's spiral.
Lights lights() {
  constexpr int light_count = 4096;
  const auto basis = rnm_basis();
  Lights lights;
  for (int k = 0; k < light_count; ++k) {
    const double z = (k + 0.5) / light_count, r = std::sqrt(1 - z * z), turn = k * pi * (3 - std::sqrt(5.0));
    const Vec3 l(Vec3d(r * std::cos(turn), r * std::sin(turn), z));
    std::array<double, 3> lm{};
    for (std::size_t i = 0; i < 3; ++i) lm[i] = std::max(0.0F, l.dot(basis[i]));
    for (std::size_t i = 0; i < 3; ++i) {
      lights.mean[i] += lm[i] / light_count;
      for (std::size_t j = 0; j < 3; ++j) lights.square[i][j] += lm[i] * lm[j] / light_count;
    }
  }
  return lights;
}

double mean_square(const Lights& lights, const std::array<double, 3>& w) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) sum += w[i] * w[j] * lights.square[i][j];
  return std::max(0.0, sum);
}

void diffuse_error(const FloatImage& changed, const FloatImage& weights, CompressionError& error) {
  const Lights all = lights();
  const double open = std::sqrt(mean_square(all, {1, 1, 1}));
  double squares = 0, bias = 0, worst = 0;
  for (int y = 0; y < weights.height(); ++y) {
    for (int x = 0; x < weights.width(); ++x) {
      std::array<double, 3> off{};
      for (std::size_t i = 0; i < 3; ++i) {
        off[i] = double(changed.texel(x, y)[i]) - weights.texel(x, y)[i];
        bias += off[i] * all.mean[i];
      }
      const double square = mean_square(all, off);
      squares += square;
      worst = std::max(worst, square);
    }
  }
  const auto texels = static_cast<double>(weights.texels());
  error.diffuse_rms = std::sqrt(squares / texels) / open;
  error.diffuse_bias = bias / texels / open;
  error.diffuse_max = std::sqrt(worst) / open;
}

double degrees_between(std::span<const float> a, std::span<const float> b) {
  const Vec3d p(a[0], a[1], a[2]), q(b[0], b[1], b[2]);
  return std::atan2(p.cross(q).length(), p.dot(q)) * 180 / pi;
}

bool has_normal(std::span<const float> w) {
  return w[0] > 0 || w[1] > 0 || w[2] > 0;
}

void angle_error(const FloatImage& changed, const FloatImage& weights, CompressionError& error) {
  const FloatImage before = bent_normals(weights), after = bent_normals(changed);
  std::vector<double> angles;
  for (int y = 0; y < weights.height(); ++y) {
    for (int x = 0; x < weights.width(); ++x) {
      if (has_normal(weights.texel(x, y)))
        angles.push_back(degrees_between(before.texel(x, y), after.texel(x, y)));
    }
  }
  if (angles.empty()) return;
  std::ranges::sort(angles);
  for (const double angle : angles) error.angle_mean += angle / static_cast<double>(angles.size());
  error.angle_p95 = angles[static_cast<std::size_t>(0.95 * static_cast<double>(angles.size() - 1))];
  error.angle_max = angles.back();
}

}  // namespace

CompressionError weights_error(const FloatImage& changed, const FloatImage& weights) {
  CompressionError error;
  diffuse_error(changed, weights, error);
  angle_error(changed, weights, error);
  return error;
}

CompressionError compression_error(const FloatImage& weights, SsbumpEncoding encoding, TextureFormat format) {
  encoding.alpha = SsbumpAlpha::none;
  return weights_error(decode_weights(through(format, encode(weights, encoding)), encoding), weights);
}

}  // namespace rnmbake
