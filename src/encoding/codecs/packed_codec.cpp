#include "encoding/codecs/packed_codec.h"

#include "encoding/codecs/lobe_codec.h"
#include "encoding/encodings.h"
#include "encoding/packing.h"

namespace rnmbake {
namespace {

class PackedCodec : public Codec {
 public:
  PackedCodec(Lobe lobe, const FourPlaces& places, const Packing& packing,
              std::span<const std::string_view> layers = packed_l1_layers)
      : lobe_(lobe), places_(places), packing_(packing), layers_(layers.begin(), layers.end()) {}

  const std::vector<std::string>& layers() const override { return layers_; }
  bool can_rotate() const override { return true; }

  Vec3 decode(std::span<const Vec3> layers, const Vec3& normal) const override {
    Vec3 light;
    for (int c = 0; c < 3; ++c)
      light[c] = layers[0][c] * shape({layers[1][c], layers[2][c], layers[3][c]}, normal);
    return light;
  }

 protected:
  [[nodiscard]] float shape(const Vec3d& t, const Vec3& normal) const {
    return static_cast<float>(lobe_(1, unpacked_ratio(t, packing_.range), Vec3d(normal)).value);
  }

  PackedNumbers numbers_in(const TexelFrame& frame, const FourBakes& bakes, EncodeCounts& counts) const {
    FourNumbers free_fit = numbers_of(lobe_, bakes);
    free_fit.v = frame.stored(free_fit.v);
    if (!free_fit.has_converged) counts.unconverged = 1;
    if (free_fit.v.length() > 2 * free_fit.a * (1 + 1e-6)) counts.over_long = 1;
    if (is_out_of_range(free_fit, packing_.range)) counts.out_of_range = 1;
    auto directions = four_directions();
    for (Vec3d& direction : directions) direction = frame.stored(direction);
    return packed(lobe_, bakes, directions, free_fit, packing_);
  }

  [[nodiscard]] FourBakes bakes_of(std::span<const Vec3> irradiance, const Vec3d& shares) const {
    FourBakes bakes{};
    for (std::size_t k = 0; k < 4; ++k) bakes[k] = Vec3d(irradiance[places_[k]]).dot(shares);
    return bakes;
  }

  Lobe lobe_;
  FourPlaces places_;
  Packing packing_;
  std::vector<std::string> layers_;

 private:
  EncodeCounts encode_texel(std::span<const Vec3> irradiance, std::span<Vec3> layers,
                            const TexelFrame& frame) const override {
    EncodeCounts counts;
    for (int c = 0; c < 3; ++c) {
      Vec3d colour(0);
      colour[c] = 1;
      const PackedNumbers numbers = numbers_in(frame, bakes_of(irradiance, colour), counts);
      layers[0][c] = static_cast<float>(numbers.a);
      for (int axis = 0; axis < 3; ++axis)
        layers[1 + static_cast<std::size_t>(axis)][c] = static_cast<float>(numbers.t[axis]);
    }
    return counts;
  }
};

class MonoCodec : public PackedCodec {
 public:
  MonoCodec(Lobe lobe, const FourPlaces& places, const Packing& packing)
      : PackedCodec(lobe, places, packing, mono_l1_layers) {}

  Vec3 decode(std::span<const Vec3> layers, const Vec3& normal) const override {
    return layers[0] * shape(Vec3d(layers[1]), normal);
  }

 private:
  EncodeCounts encode_texel(std::span<const Vec3> irradiance, std::span<Vec3> layers,
                            const TexelFrame& frame) const override {
    EncodeCounts counts;
    const FourBakes means = bakes_of(irradiance, Vec3d(1.0 / 3));
    const PackedNumbers numbers = numbers_in(frame, means, counts);
    const Vec3d flat(irradiance[places_[0]]);
    layers[0] = means[0] > 0 ? Vec3(flat * (numbers.a / means[0])) : Vec3(0);
    layers[1] = Vec3(numbers.t);
    return counts;
  }
};

}  // namespace

std::unique_ptr<const Codec> packed_codec(const CodecOptions& options, const BasisSet& directions) {
  const Lobe lobe = lobe_of(options.name);
  const FourPlaces places = four_places(directions, options.name);
  const Packing packing{options.range, options.bits};
  if (options.mono) return std::make_unique<MonoCodec>(lobe, places, packing);
  return std::make_unique<PackedCodec>(lobe, places, packing);
}

}  // namespace rnmbake
