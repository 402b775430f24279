#include "encoding/codecs/lobe_codec.h"

#include "encoding/encodings.h"
#include "encoding/geomerics.h"
#include "encoding/sh2.h"
#include "encoding/zh3.h"

#include <algorithm>
#include <limits>

namespace rnmbake {
namespace {

FourBakes bakes_of(std::span<const Vec3> irradiance, const FourPlaces& places, int colour) {
  FourBakes bakes{};
  for (std::size_t k = 0; k < 4; ++k) bakes[k] = irradiance[places[k]][colour];
  return bakes;
}

class LobeCodec : public Codec {
 public:
  LobeCodec(const BoundedLobe& lobe, const FourPlaces& places) : lobe_(lobe), places_(places) {}

  const std::vector<std::string>& layers() const override { return layers_; }
  bool can_rotate() const override { return true; }

  Vec3 decode(std::span<const Vec3> layers, const Vec3& normal) const override {
    Vec3 light;
    for (int c = 0; c < 3; ++c)
      light[c] = static_cast<float>(lobe_.lobe(layers[0][c], v_of(layers, c), Vec3d(normal)).value);
    return light;
  }

 private:
  static Vec3d v_of(std::span<const Vec3> layers, int colour) {
    return {layers[1][colour], layers[2][colour], layers[3][colour]};
  }

  void encode_texels(const Texels& texels, std::span<EncodeCounts> counts) const override {
    std::vector<FourBakes> bakes;
    bakes.reserve(3 * texels.count());
    for (std::size_t i = 0; i < texels.count(); ++i)
      for (int c = 0; c < 3; ++c) bakes.push_back(bakes_of(texels.irradiance_of(i), places_, c));
    const std::vector<FourNumbers> numbers = numbers_of(lobe_.lobe, bakes);
    for (std::size_t i = 0; i < texels.count(); ++i) {
      const std::span<Vec3> layers = texels.layers_of(i);
      for (int c = 0; c < 3; ++c) {
        const auto& [a, v, has_converged] = numbers[3 * i + static_cast<std::size_t>(c)];
        const Vec3 stored = texels.frames[i].stored(Vec3(v));
        layers[0][c] = static_cast<float>(a);
        for (int axis = 0; axis < 3; ++axis) layers[1 + static_cast<std::size_t>(axis)][c] = stored[axis];
        if (!has_converged) counts[i].unconverged = 1;
        if (is_over_long(numbers[3 * i + static_cast<std::size_t>(c)])) counts[i].over_long = 1;
      }
    }
  }

  double least_light(std::span<const Vec3> layers, const TexelFrame& frame) const override {
    double least = std::numeric_limits<double>::infinity();
    for (int c = 0; c < 3; ++c)
      least = std::min(least, lobe_.least_about(Vec3d(frame.normal), layers[0][c], v_of(layers, c)));
    return least;
  }

  BoundedLobe lobe_;
  FourPlaces places_;
  std::vector<std::string> layers_{l1_layers.begin(), l1_layers.end()};
};

}  // namespace

double BoundedLobe::least_about(const Vec3d& up, double a, const Vec3d& v) const {
  const double length = v.length();
  return length > 0 ? least(a, length, least_cosine_about(up, v, length)) : a;
}

std::unique_ptr<const Codec> lobe_codec(const CodecOptions& options, const BasisSet& directions) {
  return std::make_unique<LobeCodec>(lobe_of(options.name), four_places(directions, options.name));
}

BoundedLobe lobe_of(const std::string& encoding) {
  if (encoding == "zh3") return {zh3_lobe, zh3_least};
  if (encoding == "geomerics") return {geomerics_lobe, geomerics_least};
  return {sh2_lobe, sh2_least};
}

FourPlaces four_places(const BasisSet& directions, const std::string& encoding) {
  FourPlaces places{needed_direction(directions, flat_direction(), encoding)};
  for (std::size_t i = 0; i < 3; ++i)
    places[i + 1] = needed_direction(directions, rnm_set().directions[i], encoding);
  return places;
}

std::vector<FourNumbers> numbers_of(Lobe lobe, std::span<const FourBakes> bakes) {
  std::vector<FourNumbers> numbers(bakes.size());
  if (lobe == sh2_lobe) {
    std::ranges::transform(bakes, numbers.begin(), linear_numbers);
  } else {
    refit(lobe, bakes, numbers);
  }
  return numbers;
}

bool is_over_long(const FourNumbers& numbers) {
  return numbers.v.length() > 2 * numbers.a * (1 + 1e-6);
}

}  // namespace rnmbake
