// encoding/codec.h - one way to keep a texel's directional light: from baked values to coefficients and back.
#pragma once

#include "base/math.h"
#include "encoding/basis_set.h"
#include "encoding/texel_frame.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace rnmbake {

struct CodecOptions {
  std::string name;  // one of codec_names(), encoding/codecs/make_codec.h
  // How sh2, zh3 and geomerics are packed: encoding/refit/packing.h.
  double range = 0;   // K: |v_i| <= K a for each axis; 0: a and v as they are
  int bits = 0;       // of each of v's components: 8, 16, or 0 for floats
  bool mono = false;  // one v / a for all colours, that of the mean of R, G and B
};

/// What had to be bent, in texels.
struct EncodeCounts {
  std::size_t texels = 0;
  std::size_t non_finite = 0;  // bakes that are no numbers, or beyond 1e30: written as darkness
  std::size_t negative_lobes =
      0;  // decodes below -1e-3 of the greatest bake at some normal tilted up to 60 degrees
  std::size_t over_long = 0;     // |v| > 2a, which no light's harmonics have: the fit of a hemisphere may
  std::size_t out_of_range = 0;  // did not fit the packing's range and were fitted again within it
  std::size_t unconverged = 0;   // a refit that does not return the bakes; the nearest numbers were written

  EncodeCounts& operator+=(const EncodeCounts& other);
};

/// Texels one after the other, as many as there are frames.
struct Texels {
  std::span<const Vec3> irradiance;    // of each texel E/pi, RGB, at each direction, in the codec's order
  std::span<Vec3> layers;              // of each texel RGB for each layer: written, always finite
  std::span<const TexelFrame> frames;  // to the space of the layers

  [[nodiscard]] std::size_t count() const { return frames.size(); }
  [[nodiscard]] std::span<const Vec3> irradiance_of(std::size_t texel) const {
    const std::size_t directions = irradiance.size() / count();
    return irradiance.subspan(texel * directions, directions);
  }
  [[nodiscard]] std::span<Vec3> layers_of(std::size_t texel) const {
    const std::size_t each = layers.size() / count();
    return layers.subspan(texel * each, each);
  }
};

class Codec {
 public:
  Codec() = default;
  Codec(const Codec&) = delete;
  Codec& operator=(const Codec&) = delete;
  virtual ~Codec() = default;

  /// Names of the layers, each RGB: what a file of this encoding holds.
  [[nodiscard]] virtual const std::vector<std::string>& layers() const = 0;

  /// Layers may be kept in any space that a TexelFrame leads to; otherwise encode() expects none.
  [[nodiscard]] virtual bool can_rotate() const = 0;

  /// Writes the layers, and the counts of each texel.
  void encode(const Texels& texels, std::span<EncodeCounts> counts) const;

  /// One texel.
  EncodeCounts encode(std::span<const Vec3> irradiance, std::span<Vec3> layers,
                      const TexelFrame& frame = {}) const;

  /// E/pi, RGB, for a unit normal in the space of the layers. May be negative where the lobe is.
  [[nodiscard]] virtual Vec3 decode(std::span<const Vec3> layers, const Vec3& normal) const = 0;

 private:
  /// Of finite bakes. Adds to the counts.
  virtual void encode_texels(const Texels& texels, std::span<EncodeCounts> counts) const = 0;

  /// No channel of decode() is below it at any normal tilted up to 60 degrees; -infinity where that would
  /// have to be searched. Spares most texels that search.
  [[nodiscard]] virtual double least_light(std::span<const Vec3> layers, const TexelFrame& frame) const;

  [[nodiscard]] bool is_negative(std::span<const Vec3> irradiance, std::span<const Vec3> layers,
                                 const TexelFrame& frame) const;
};

/// A codec that knows one texel at a time.
class TexelCodec : public Codec {
 private:
  void encode_texels(const Texels& texels, std::span<EncodeCounts> counts) const final;

  /// Of finite bakes.
  virtual EncodeCounts encode_texel(std::span<const Vec3> irradiance, std::span<Vec3> layers,
                                    const TexelFrame& frame) const = 0;
};

/// Where the set holds the direction (within 1e-3) under its name. Throws Error(unsupported), naming the
/// encoding, where it does not.
[[nodiscard]] std::size_t needed_direction(const BasisSet& set, const BasisDirection& wanted,
                                           const std::string& encoding);

}  // namespace rnmbake
