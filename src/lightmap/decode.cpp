#include "lightmap/decode.h"

#include "base/error.h"
#include "encoding/codecs/make_codec.h"
#include "encoding/flip_green.h"
#include "encoding/rnm.h"
#include "image/sample.h"
#include "lightmap/frames.h"
#include "lightmap/normalize.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rnmbake {
namespace {

void require_layers(const Lightmap& lightmap, DecodeVariant variant) {
  const bool scales = variant == DecodeVariant::vrad && lightmap.metadata.normalize == Normalize::none;
  if ((variant == DecodeVariant::single || scales) && !lightmap.holds(flat_encoding)) {
    fail(ExitCode::unsupported,
         "the {} decode needs the flat layer, which this lightmap does not have; bake flat too",
         name_of(variant));
  }
  if (variant == DecodeVariant::single || variant == DecodeVariant::encoded) return;
  if (!lightmap.holds(rnm_encoding)) {
    fail(ExitCode::unsupported, "the {} decode needs the layers rnm0, rnm1 and rnm2; bake all three",
         name_of(variant));
  }
}

template <typename NormalAt>
FloatImage decode_all(const LightmapDecoder& decoder, FloatImage result, Green green, NormalAt normal_at) {
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x) {
      set_vec3(result, x, y, decoder.at(texel_uv(result, x, y), normal_at(x, y), green));
    }
  }
  return result;
}

Vec3 normal_from(std::span<const float> texel, const VectorSource& source) {
  const auto component = [&](std::size_t i) {
    const float value = texel[static_cast<std::size_t>(source.places[i])];
    return source.is_signed ? value : 2 * value - 1;
  };
  const float x = component(0), y = component(1);
  const bool has_z = source.places.size() > 2;
  const Vec3 normal(x, y, has_z ? component(2) : std::sqrt(std::max(0.0F, 1 - x * x - y * y)));
  const float length = normal.length();
  return length > 0 && std::isfinite(length) ? normal / length : Vec3(0, 0, 1);
}

std::optional<std::string> rnm_obstacle(const LightmapMetadata& metadata, DecodeVariant variant) {
  if (!holds_rnm({"header", metadata.bases}))
    return "its directions are not the three of the Half-Life 2 basis";
  if (variant == DecodeVariant::linear && metadata.normalize == Normalize::flat) {
    return "its maps are scaled to the flat bake (normalize flat), which the linear decode does not expect";
  }
  return std::nullopt;
}

}  // namespace

Lightmap lightmap_of(const LayeredImage& image, const LightmapMetadata& metadata) {
  Lightmap lightmap{metadata, {}, {}, {}, {}};
  for (const Layer& layer : image.layers) {
    const auto places = places_of(layer.channels, "RGB");
    if (!places.empty()) {
      lightmap.layers.emplace(name_of_exr_layer(layer.name),
                              layer.pixels.channels() == 3 ? layer.pixels : picked(layer.pixels, places));
    }
    if (layer.name == "coverage" && layer.pixels.channels() == 1) lightmap.coverage = layer.pixels;
    if (metadata.space != "world") continue;
    if (layer.name == "tangent") lightmap.tangent = layer.pixels;
    if (layer.name == "normal") lightmap.normal = layer.pixels;
  }
  return lightmap;
}

bool Lightmap::holds(const Encoding& encoding) const {
  return std::ranges::all_of(encoding.layers, [&](std::string_view name) { return layers.contains(name); });
}

FloatImage Lightmap::take(std::string_view layer) {
  const auto found = layers.find(layer);
  return found == layers.end() ? FloatImage() : std::move(layers.extract(found).mapped());
}

const char* name_of(DecodeVariant variant) {
  switch (variant) {
    case DecodeVariant::squared:
      return "squared";
    case DecodeVariant::linear:
      return "linear";
    case DecodeVariant::vrad:
      return "vrad";
    case DecodeVariant::single:
      return "single";
    case DecodeVariant::encoded:
      return "encoded";
  }
  return "unknown";
}

DecodeVariant natural_variant(const LightmapMetadata& metadata) {
  return metadata.is_encoded() ? DecodeVariant::encoded : DecodeVariant::squared;
}

FloatImage normals_of(const LayeredImage& picture, const std::string& file) {
  const VectorSource source = vector_source(picture, file);
  return normals_of(source.layer->pixels, source);
}

FloatImage normals_of(const FloatImage& pixels, const VectorSource& source) {
  FloatImage normals(pixels.width(), pixels.height(), 3);
  for (int y = 0; y < pixels.height(); ++y) {
    for (int x = 0; x < pixels.width(); ++x) {
      set_vec3(normals, x, y, normal_from(pixels.texel(x, y), source));
    }
  }
  return normals;
}

std::optional<std::string> decode_obstacle(const LightmapMetadata& metadata, DecodeVariant variant) {
  if (metadata.units != "E/pi") return "its units are '" + metadata.units + "'";
  if (metadata.handedness != "right") return "its frame is " + metadata.handedness + "-handed";
  if (variant == DecodeVariant::encoded) {
    if (metadata.is_encoded()) return std::nullopt;
    return metadata.is_baked() ? "its maps are those of a bake, not of another encoding"
                               : "its convention is '" + metadata.convention + "'";
  }
  if (!metadata.is_baked()) return "its convention is '" + metadata.convention + "'";
  if (metadata.space != "tangent") return "its directions are in " + metadata.space + " space";
  return variant == DecodeVariant::single ? std::nullopt : rnm_obstacle(metadata, variant);
}

LightmapDecoder::LightmapDecoder(Lightmap lightmap, DecodeVariant variant) : variant_(variant) {
  require_layers(lightmap, variant);
  metadata_ = std::move(lightmap.metadata);
  coverage_ = std::move(lightmap.coverage);
  if (variant == DecodeVariant::encoded) {
    take_encoded(lightmap);
    return;
  }
  flat_ = lightmap.take(flat_layers.front());
  for (std::size_t i = 0; i < rnm_.size(); ++i) rnm_[i] = lightmap.take(rnm_layers[i]);
  if (variant == DecodeVariant::vrad && metadata_.normalize == Normalize::none)
    normalize_to_flat({&rnm_[0], &rnm_[1], &rnm_[2]}, flat_);
}

void LightmapDecoder::take_encoded(Lightmap& lightmap) {
  codec_ = make_codec(metadata_.codec, {"the header", metadata_.bases});
  for (const std::string& name : codec_->layers()) {
    encoded_.push_back(lightmap.take(name));
    if (encoded_.back().empty()) {
      fail(ExitCode::unsupported,
           "the {} decode needs the layer {}, which this lightmap does not have; convert it again",
           metadata_.convention, name);
    }
  }
  tangent_ = std::move(lightmap.tangent);
  normal_ = std::move(lightmap.normal);
  if (metadata_.space == "world" && (tangent_.empty() || normal_.empty())) {
    fail(ExitCode::unsupported,
         "this lightmap is in world space and has no layers tangent and normal; convert it again from a bake "
         "with "
         "--frames");
  }
}

const FloatImage& LightmapDecoder::any_layer() const {
  if (!encoded_.empty()) return encoded_.front();
  return flat_.empty() ? rnm_[0] : flat_;
}

std::array<Tap, 4> LightmapDecoder::taps_at(const Vec2& uv) const {
  const auto taps = bilinear_taps(any_layer(), uv, Border::clamp);
  return coverage_.empty() ? taps : covered_taps(taps, coverage_);
}

/// Layers are mixed first, as a GPU does it; the frame is that of the texel which counts most.
Vec3 LightmapDecoder::encoded_at(const std::array<Tap, 4>& taps, const Vec3& normal) const {
  std::vector<Vec3> values;
  values.reserve(encoded_.size());
  for (const FloatImage& layer : encoded_) values.push_back(sampled_vec3(layer, taps));
  if (metadata_.space != "world") return codec_->decode(values, normal);
  const Tap& most = *std::ranges::max_element(taps, {}, &Tap::weight);
  const auto frame = frame_at(tangent_, normal_, most.x, most.y, metadata_.green);
  return codec_->decode(values, frame.value_or(TexelFrame{}).stored(normal));
}

std::array<Vec3, 3> LightmapDecoder::rnm_at(const Vec2& uv) const {
  const auto taps = taps_at(uv);
  return {sampled_vec3(rnm_[0], taps), sampled_vec3(rnm_[1], taps), sampled_vec3(rnm_[2], taps)};
}

Vec3 LightmapDecoder::at(const Vec2& uv, const Vec3& normal, Green green) const {
  const auto taps = taps_at(uv);
  if (variant_ == DecodeVariant::single) return sampled_vec3(flat_, taps);
  const Vec3 turned = green == metadata_.green ? normal : flip_green(normal);
  if (codec_) return encoded_at(taps, turned);
  const std::array<Vec3, 3> maps = rnm_at(uv);
  return variant_ == DecodeVariant::linear ? rnm_decode_linear(maps, turned)
                                           : rnm_decode_squared(maps, turned);
}

int LightmapDecoder::width() const {
  return any_layer().width();
}

int LightmapDecoder::height() const {
  return any_layer().height();
}

FloatImage decode(Lightmap lightmap, const NormalPicture& normal_map, DecodeVariant variant) {
  const FloatImage& normals = normal_map.normals;
  const LightmapDecoder decoder(std::move(lightmap), variant);
  return decode_all(decoder, FloatImage(normals.width(), normals.height(), 3), normal_map.green,
                    [&](int x, int y) { return vec3_at(normals, x, y); });
}

FloatImage decode(Lightmap lightmap, const Vec3& normal, Green green, DecodeVariant variant) {
  const LightmapDecoder decoder(std::move(lightmap), variant);
  const Vec3 unit = normal.normalized();
  return decode_all(decoder, FloatImage(decoder.width(), decoder.height(), 3), green,
                    [&](int, int) { return unit; });
}

}  // namespace rnmbake
