#include "encoding/codecs/lobe_codec.h"

#include "encoding/encodings.h"
#include "encoding/geomerics.h"
#include "encoding/sh2.h"
#include "encoding/zh3.h"

namespace rnmbake {
namespace {

FourBakes bakes_of(std::span<const Vec3> irradiance, const FourPlaces& places, int colour) {
  FourBakes bakes{};
  for (std::size_t k = 0; k < 4; ++k) bakes[k] = irradiance[places[k]][colour];
  return bakes;
}

class LobeCodec : public Codec {
 public:
  LobeCodec(Lobe lobe, const FourPlaces& places) : lobe_(lobe), places_(places) {}

  const std::vector<std::string>& layers() const override { return layers_; }
  bool can_rotate() const override { return true; }

  Vec3 decode(std::span<const Vec3> layers, const Vec3& normal) const override {
    Vec3 light;
    for (int c = 0; c < 3; ++c) {
      const Vec3d v(layers[1][c], layers[2][c], layers[3][c]);
      light[c] = static_cast<float>(lobe_(layers[0][c], v, Vec3d(normal)).value);
    }
    return light;
  }

 private:
  EncodeCounts encode_texel(std::span<const Vec3> irradiance, std::span<Vec3> layers,
                            const TexelFrame& frame) const override {
    EncodeCounts counts;
    for (int c = 0; c < 3; ++c) {
      const FourNumbers numbers = numbers_of(lobe_, bakes_of(irradiance, places_, c));
      const Vec3 v = frame.stored(Vec3(numbers.v));
      layers[0][c] = static_cast<float>(numbers.a);
      for (int axis = 0; axis < 3; ++axis) layers[1 + static_cast<std::size_t>(axis)][c] = v[axis];
      if (!numbers.has_converged) counts.unconverged = 1;
      if (numbers.v.length() > 2 * numbers.a * (1 + 1e-6)) counts.over_long = 1;
    }
    return counts;
  }

  Lobe lobe_;
  FourPlaces places_;
  std::vector<std::string> layers_{l1_layers.begin(), l1_layers.end()};
};

}  // namespace

std::unique_ptr<const Codec> lobe_codec(const CodecOptions& options, const BasisSet& directions) {
  return std::make_unique<LobeCodec>(lobe_of(options.name), four_places(directions, options.name));
}

Lobe lobe_of(const std::string& encoding) {
  return encoding == "zh3" ? zh3_lobe : encoding == "geomerics" ? geomerics_lobe : sh2_lobe;
}

FourPlaces four_places(const BasisSet& directions, const std::string& encoding) {
  FourPlaces places{needed_direction(directions, flat_direction(), encoding)};
  for (std::size_t i = 0; i < 3; ++i)
    places[i + 1] = needed_direction(directions, rnm_set().directions[i], encoding);
  return places;
}

FourNumbers numbers_of(Lobe lobe, const FourBakes& bakes) {
  return lobe == sh2_lobe ? linear_numbers(bakes) : refit(lobe, bakes);
}

}  // namespace rnmbake
