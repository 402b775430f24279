#include "encoding/codecs/direction_codecs.h"

#include "encoding/ahd.h"
#include "encoding/codecs/lobe_codec.h"
#include "encoding/encodings.h"
#include "encoding/fit/gauss_newton.h"
#include "encoding/refit/refit.h"
#include "encoding/sh2.h"
#include "encoding/unity_dominant.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace rnmbake {
namespace {

FourBakes mean_bakes(std::span<const Vec3> irradiance, const FourPlaces& places) {
  FourBakes means{};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3d light(irradiance[places[k]]);
    means[k] = (light.x + light.y + light.z) / 3;
  }
  return means;
}

Vec3d unit_or_up(const Vec3d& v) {
  const double length = v.length();
  return length > 0 ? v / length : Vec3d(0, 0, 1);
}

class AhdCodec : public TexelCodec {
 public:
  explicit AhdCodec(const FourPlaces& places) : places_(places) {}

  const std::vector<std::string>& layers() const override { return layers_; }
  bool can_rotate() const override { return true; }
  Vec3 decode(std::span<const Vec3> layers, const Vec3& normal) const override {
    return ahd_decode(layers[0], layers[1], layers[2], normal);
  }

 private:
  EncodeCounts encode_texel(std::span<const Vec3> irradiance, std::span<Vec3> layers,
                            const TexelFrame& frame) const override {
    const FourNumbers numbers = nearest_numbers(ahd_lobe, mean_bakes(irradiance, places_));
    const Vec3d direction = unit_or_up(numbers.v);
    std::array<double, 4> seen{};
    for (std::size_t k = 0; k < 4; ++k) seen[k] = std::max(0.0, direction.dot(four_directions()[k]));
    for (int c = 0; c < 3; ++c) {
      const double flat = irradiance[places_[0]][c];
      double product = 0, square = 0;
      for (std::size_t k = 1; k < 4; ++k) {
        product += (seen[k] - seen[0]) * (irradiance[places_[k]][c] - flat);
        square += (seen[k] - seen[0]) * (seen[k] - seen[0]);
      }
      double highlight = square > 0 ? std::max(0.0, product / square) : 0;
      if (highlight * seen[0] > flat) highlight = std::max(0.0, flat / seen[0]);
      layers[0][c] = static_cast<float>(flat - highlight * seen[0]);
      layers[1][c] = static_cast<float>(highlight);
    }
    layers[2] = Vec3(frame.stored(direction));
    EncodeCounts counts;
    counts.unconverged = numbers.has_converged ? 0 : 1;
    return counts;
  }

  FourPlaces places_;
  std::vector<std::string> layers_{ahd_layers.begin(), ahd_layers.end()};
};

/// The unit d of the least sum over the basis of (flat (1 + d.b) / (1 + d.z) - bake)^2, from `start` on.
Vec3d dominant_on_sphere(const FourBakes& bakes, const Vec3d& start) {
  const double greatest = *std::ranges::max_element(bakes), flat = bakes[0] / greatest;
  const auto model = [&](const std::array<double, 3>& x) {
    Residual<3, 3> residual;
    const double length = Vec3d(x[0], x[1], x[2]).length();
    const Vec3d d = Vec3d(x[0], x[1], x[2]) / length;
    const double up = 1 + d.z;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d& b = four_directions()[k + 1];
      const double share = (1 + d.dot(b)) / up;
      const Vec3d by_d = (b - Vec3d(0, 0, share)) * (flat / up);
      const Vec3d by_x = (by_d - d * by_d.dot(d)) / length;
      residual.values[k] =
          up > 0 ? flat * share - bakes[k + 1] / greatest : std::numeric_limits<double>::infinity();
      residual.jacobian[k] = {by_x.x, by_x.y, by_x.z};
    }
    return residual;
  };
  constexpr double far = std::numeric_limits<double>::max();
  const Bounds<3> bounds{{-far, -far, -far}, {far, far, far}};
  const auto found = damped_gauss_newton(model, std::array{start.x, start.y, start.z}, bounds).at;
  return Vec3d(found[0], found[1], found[2]).normalized();
}

class DominantCodec : public TexelCodec {
 public:
  explicit DominantCodec(const FourPlaces& places) : places_(places) {}

  const std::vector<std::string>& layers() const override { return layers_; }
  bool can_rotate() const override { return true; }
  Vec3 decode(std::span<const Vec3> layers, const Vec3& normal) const override {
    return dominant_decode(layers[0], layers[1], layers[2].x, normal);
  }

 private:
  EncodeCounts encode_texel(std::span<const Vec3> irradiance, std::span<Vec3> layers,
                            const TexelFrame& frame) const override {
    EncodeCounts counts;
    const FourBakes bakes = mean_bakes(irradiance, places_);
    Vec3d direction(0);
    if (bakes[0] > 0) {
      const FourNumbers linear = linear_numbers(bakes);
      counts.out_of_range = linear.v.length() > linear.a ? 1 : 0;
      // A start below the horizon may lie where the decode of the flat normal has no weight.
      const Vec3d towards = unit_or_up(Vec3d(linear.v.x, linear.v.y, std::max(linear.v.z, 0.0)));
      direction = counts.out_of_range == 0 ? linear.v / linear.a : dominant_on_sphere(bakes, towards);
    }
    layers[0] = irradiance[places_[0]];
    layers[1] = Vec3(frame.stored(direction) * 0.5 + Vec3d(0.5));
    layers[2] = Vec3(static_cast<float>((1 + direction.z) / 2));
    return counts;
  }

  FourPlaces places_;
  std::vector<std::string> layers_{dominant_layers.begin(), dominant_layers.end()};
};

}  // namespace

std::unique_ptr<const Codec> ahd_codec(const CodecOptions& options, const BasisSet& directions) {
  return std::make_unique<AhdCodec>(four_places(directions, options.name));
}

std::unique_ptr<const Codec> dominant_codec(const CodecOptions& options, const BasisSet& directions) {
  return std::make_unique<DominantCodec>(four_places(directions, options.name));
}

}  // namespace rnmbake
