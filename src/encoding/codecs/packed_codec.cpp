#include "encoding/codecs/packed_codec.h"

#include "encoding/codecs/lobe_codec.h"
#include "encoding/encodings.h"
#include "encoding/refit/packing.h"

#include <algorithm>
#include <limits>

namespace rnmbake {
namespace {

/// Four numbers for each colour, or for their mean.
class PackedCodec : public Codec {
 public:
  PackedCodec(const BoundedLobe& lobe, const FourPlaces& places, const Packing& packing,
              std::span<const std::string_view> layers)
      : lobe_(lobe), places_(places), packing_(packing), layers_(layers.begin(), layers.end()) {}

  const std::vector<std::string>& layers() const override { return layers_; }
  bool can_rotate() const override { return true; }

 protected:
  /// The lobe of a = 1.
  [[nodiscard]] float shape(const Vec3d& t, const Vec3& normal) const {
    return static_cast<float>(lobe_.lobe(1, unpacked_ratio(t, packing_.range), Vec3d(normal)).value);
  }
  [[nodiscard]] double least_shape(const Vec3d& t, const TexelFrame& frame) const {
    return lobe_.least_about(Vec3d(frame.normal), 1, unpacked_ratio(t, packing_.range));
  }

  /// Bakes of a mix of the colours.
  [[nodiscard]] FourBakes bakes_of(std::span<const Vec3> irradiance, const Vec3d& shares) const {
    FourBakes bakes{};
    for (std::size_t k = 0; k < 4; ++k) bakes[k] = Vec3d(irradiance[places_[k]]).dot(shares);
    return bakes;
  }

  /// As many of each texel, one after the other, as there are bakes.
  [[nodiscard]] std::vector<PackedNumbers> packed_of(std::span<const FourBakes> bakes, const Texels& texels,
                                                     std::span<EncodeCounts> counts) const {
    const std::vector<FourNumbers> numbers = numbers_of(lobe_.lobe, bakes);
    std::vector<FreeFit> fits(bakes.size());
    for (std::size_t i = 0; i < bakes.size(); ++i) {
      const std::size_t texel = i / (bakes.size() / texels.count());
      const TexelFrame& frame = texels.frames[texel];
      fits[i] = {bakes[i], four_directions(), numbers[i]};
      fits[i].numbers.v = frame.stored(numbers[i].v);
      for (Vec3d& direction : fits[i].directions) direction = frame.stored(direction);
      if (!numbers[i].has_converged) counts[texel].unconverged = 1;
      if (is_over_long(fits[i].numbers)) counts[texel].over_long = 1;
      if (is_out_of_range(fits[i].numbers, packing_.range)) counts[texel].out_of_range = 1;
    }
    return packed(lobe_.lobe, fits, packing_);
  }

  [[nodiscard]] std::size_t flat() const { return places_[0]; }

 private:
  BoundedLobe lobe_;
  FourPlaces places_;
  Packing packing_;
  std::vector<std::string> layers_;
};

class ColourCodec : public PackedCodec {
 public:
  ColourCodec(const BoundedLobe& lobe, const FourPlaces& places, const Packing& packing)
      : PackedCodec(lobe, places, packing, packed_l1_layers) {}

  Vec3 decode(std::span<const Vec3> layers, const Vec3& normal) const override {
    Vec3 light;
    for (int c = 0; c < 3; ++c) light[c] = layers[0][c] * shape(t_of(layers, c), normal);
    return light;
  }

 private:
  static Vec3d t_of(std::span<const Vec3> layers, int colour) {
    return {layers[1][colour], layers[2][colour], layers[3][colour]};
  }

  void encode_texels(const Texels& texels, std::span<EncodeCounts> counts) const override {
    std::vector<FourBakes> bakes;
    bakes.reserve(3 * texels.count());
    for (std::size_t i = 0; i < texels.count(); ++i) {
      for (const Vec3d& colour : {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)})
        bakes.push_back(bakes_of(texels.irradiance_of(i), colour));
    }
    const std::vector<PackedNumbers> numbers = packed_of(bakes, texels, counts);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const std::span<Vec3> layers = texels.layers_of(i / 3);
      const int colour = static_cast<int>(i % 3);
      layers[0][colour] = static_cast<float>(numbers[i].a);
      for (int axis = 0; axis < 3; ++axis)
        layers[1 + static_cast<std::size_t>(axis)][colour] = static_cast<float>(numbers[i].t[axis]);
    }
  }

  double least_light(std::span<const Vec3> layers, const TexelFrame& frame) const override {
    double least = std::numeric_limits<double>::infinity();
    for (int c = 0; c < 3; ++c) least = std::min(least, layers[0][c] * least_shape(t_of(layers, c), frame));
    return least;
  }
};

class MonoCodec : public PackedCodec {
 public:
  MonoCodec(const BoundedLobe& lobe, const FourPlaces& places, const Packing& packing)
      : PackedCodec(lobe, places, packing, mono_l1_layers) {}

  Vec3 decode(std::span<const Vec3> layers, const Vec3& normal) const override {
    return layers[0] * shape(Vec3d(layers[1]), normal);
  }

 private:
  void encode_texels(const Texels& texels, std::span<EncodeCounts> counts) const override {
    std::vector<FourBakes> means;
    means.reserve(texels.count());
    for (std::size_t i = 0; i < texels.count(); ++i)
      means.push_back(bakes_of(texels.irradiance_of(i), Vec3d(1.0 / 3)));
    const std::vector<PackedNumbers> numbers = packed_of(means, texels, counts);
    for (std::size_t i = 0; i < texels.count(); ++i) {
      const std::span<Vec3> layers = texels.layers_of(i);
      const Vec3d flat(texels.irradiance_of(i)[this->flat()]);
      layers[0] = means[i][0] > 0 ? Vec3(flat * (numbers[i].a / means[i][0])) : Vec3(0);
      layers[1] = Vec3(numbers[i].t);
    }
  }

  double least_light(std::span<const Vec3> layers, const TexelFrame& frame) const override {
    // Times a colour below 0 the greatest of the shape would be the least.
    if (std::min({layers[0].x, layers[0].y, layers[0].z}) < 0)
      return -std::numeric_limits<double>::infinity();
    return std::min(0.0, max_channel(layers[0]) * least_shape(Vec3d(layers[1]), frame));
  }
};

}  // namespace

std::unique_ptr<const Codec> packed_codec(const CodecOptions& options, const BasisSet& directions) {
  const BoundedLobe lobe = lobe_of(options.name);
  const FourPlaces places = four_places(directions, options.name);
  const Packing packing{options.range, options.bits};
  if (options.mono) return std::make_unique<MonoCodec>(lobe, places, packing);
  return std::make_unique<ColourCodec>(lobe, places, packing);
}

}  // namespace rnmbake
