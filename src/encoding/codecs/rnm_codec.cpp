#include "encoding/codecs/rnm_codec.h"

#include "encoding/encodings.h"
#include "encoding/rnm.h"

#include <algorithm>

namespace rnmbake {
namespace {

class FlatCodec : public TexelCodec {
 public:
  explicit FlatCodec(std::size_t flat) : flat_(flat) {}

  const std::vector<std::string>& layers() const override { return layers_; }
  bool can_rotate() const override { return true; }
  Vec3 decode(std::span<const Vec3> layers, const Vec3&) const override { return layers[0]; }

 private:
  EncodeCounts encode_texel(std::span<const Vec3> irradiance, std::span<Vec3> layers,
                            const TexelFrame&) const override {
    layers[0] = irradiance[flat_];
    return {};
  }

  std::size_t flat_;
  std::vector<std::string> layers_{std::string(flat_layers.front())};
};

enum class RnmDialect { clipped, scaled_to_flat, bakery };

class RnmCodec : public TexelCodec {
 public:
  RnmCodec(RnmDialect dialect, const std::array<std::size_t, 3>& maps, std::size_t flat)
      : dialect_(dialect), maps_(maps), flat_(flat) {}

  const std::vector<std::string>& layers() const override { return layers_; }
  bool can_rotate() const override { return false; }

  Vec3 decode(std::span<const Vec3> layers, const Vec3& normal) const override {
    const std::array maps{layers[0], layers[1], layers[2]};
    return dialect_ == RnmDialect::bakery ? rnm_decode_linear(maps, normal)
                                          : rnm_decode_squared(maps, normal);
  }

 private:
  EncodeCounts encode_texel(std::span<const Vec3> irradiance, std::span<Vec3> layers,
                            const TexelFrame&) const override {
    for (std::size_t i = 0; i < 3; ++i) layers[i] = irradiance[maps_[i]];
    if (dialect_ != RnmDialect::scaled_to_flat) return {};
    for (int c = 0; c < 3; ++c) {
      const auto scaled =
          rnm_scaled_to_flat({layers[0][c], layers[1][c], layers[2][c]}, irradiance[flat_][c]);
      for (std::size_t i = 0; i < 3; ++i) layers[i][c] = scaled[i];
    }
    return {};
  }

  RnmDialect dialect_;
  std::array<std::size_t, 3> maps_;
  std::size_t flat_;
  std::vector<std::string> layers_{rnm_layers.begin(), rnm_layers.end()};
};

}  // namespace

std::unique_ptr<const Codec> flat_codec(const BasisSet& directions) {
  return std::make_unique<FlatCodec>(needed_direction(directions, flat_direction(), "flat"));
}

std::unique_ptr<const Codec> rnm_codec(const std::string& name, const BasisSet& directions) {
  const RnmDialect dialect = name == "rnm-vrad"     ? RnmDialect::scaled_to_flat
                             : name == "rnm-bakery" ? RnmDialect::bakery
                                                    : RnmDialect::clipped;
  const bool needs_flat = dialect == RnmDialect::scaled_to_flat;
  std::array<std::size_t, 3> maps{};
  for (std::size_t i = 0; i < 3; ++i) maps[i] = needed_direction(directions, rnm_set().directions[i], name);
  return std::make_unique<RnmCodec>(dialect, maps,
                                    needs_flat ? needed_direction(directions, flat_direction(), name) : 0);
}

}  // namespace rnmbake
