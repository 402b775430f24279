// lightmap/decode.h - what a shader sees: lightmap and normal map together, as the field defines it, on the
// CPU.
#pragma once

#include "base/math.h"
#include "encoding/codec.h"
#include "encoding/encodings.h"
#include "image/channels.h"
#include "image/float_image.h"
#include "image/layered_exr.h"
#include "image/sample.h"
#include "lightmap/metadata.h"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

/// A lightmap file taken apart.
struct Lightmap {
  LightmapMetadata metadata;
  std::map<std::string, FloatImage, std::less<>> layers;  // RGB, by name; the plain one is "flat"
  FloatImage coverage;                                    // one channel; empty: the file has none
  FloatImage tangent, normal;                             // of a lightmap in world space: lightmap/frames.h

  [[nodiscard]] bool holds(const Encoding& encoding) const;

  /// Takes the layer out; an empty picture where the file does not hold it.
  [[nodiscard]] FloatImage take(std::string_view layer);
};

[[nodiscard]] Lightmap lightmap_of(const LayeredImage& image, const LightmapMetadata& metadata);

enum class DecodeVariant {
  squared,  // sum w LM / sum w with w = sat(dot)^2: Source, corrected
  linear,   // sum sat(dot) LM: Bakery
  vrad,     // as squared, on maps scaled so that a flat normal returns the flat bake
  single,   // the flat bake, whatever the normal
  encoded,  // by the decoder of the encoding that the header names (encoding/codec.h)
};

[[nodiscard]] const char* name_of(DecodeVariant variant);

/// For the maps of a bake squared, for a converted lightmap encoded.
[[nodiscard]] DecodeVariant natural_variant(const LightmapMetadata& metadata);

/// Tangent-space normals: RGB of unit vectors, `green` says where y points.
struct NormalPicture {
  FloatImage normals;
  Green green = Green::y_up;
};

/// Turns a normal map's picture into unit vectors: 2t - 1, renormalised. A picture with a value below 0 or
/// with channels X,Y,Z is taken to hold vectors already; one with two channels gets z = sqrt(1 - x^2 - y^2);
/// a vector of length 0 becomes (0, 0, 1). Throws Error(invalid_input), naming `file`, where there is no such
/// layer.
[[nodiscard]] FloatImage normals_of(const LayeredImage& picture, const std::string& file);

/// The same of some rows: `pixels` of the source's layer.
[[nodiscard]] FloatImage normals_of(const FloatImage& pixels, const VectorSource& source);

/// Why the numbers of this file do not mean what the variant takes them for; nothing where they do.
[[nodiscard]] std::optional<std::string> decode_obstacle(const LightmapMetadata& metadata,
                                                         DecodeVariant variant);

/// Decodes at single places, as a shader does: maps bilinearly, without uncovered texels where a covered one
/// is near, then the normal. Maps that the header calls normalized are never scaled again.
class LightmapDecoder {
 public:
  /// Throws Error(unsupported), naming it, where a layer that the variant needs is missing, or the frames of
  /// a lightmap in world space.
  LightmapDecoder(Lightmap lightmap, DecodeVariant variant);

  /// E/pi. `normal`: unit, tangent space; turned to the lightmap's green.
  [[nodiscard]] Vec3 at(const Vec2& uv, const Vec3& normal, Green green = Green::y_up) const;

  /// The three maps there, for decodes of other things than normals.
  [[nodiscard]] std::array<Vec3, 3> rnm_at(const Vec2& uv) const;

  [[nodiscard]] const LightmapMetadata& metadata() const { return metadata_; }
  [[nodiscard]] int width() const;
  [[nodiscard]] int height() const;

 private:
  void take_encoded(Lightmap& lightmap);
  [[nodiscard]] const FloatImage& any_layer() const;
  [[nodiscard]] std::array<Tap, 4> taps_at(const Vec2& uv) const;
  [[nodiscard]] Vec3 encoded_at(const std::array<Tap, 4>& taps, const Vec3& normal) const;

  LightmapMetadata metadata_;
  FloatImage flat_;                     // empty where the file does not hold it
  std::array<FloatImage, 3> rnm_;       // the same
  std::shared_ptr<const Codec> codec_;  // of the variant `encoded`, with its layers
  std::vector<FloatImage> encoded_;
  FloatImage tangent_, normal_;
  FloatImage coverage_;
  DecodeVariant variant_;
};

/// The lit picture, RGB in E/pi, of the normal map's size. Lightmap and normal map share one UV layout.
/// Throws as LightmapDecoder.
[[nodiscard]] FloatImage decode(Lightmap lightmap, const NormalPicture& normal_map, DecodeVariant variant);

/// The same with one normal everywhere; of the lightmap's size.
[[nodiscard]] FloatImage decode(Lightmap lightmap, const Vec3& normal, Green green, DecodeVariant variant);

}  // namespace rnmbake
