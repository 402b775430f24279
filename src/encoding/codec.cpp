#include "encoding/codec.h"

#include "base/error.h"
#include "encoding/lobe_codec.h"
#include "encoding/rnm_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace rnmbake {
namespace {

using Maker = std::unique_ptr<const Codec> (*)(const CodecOptions&, const BasisSet&);

struct NamedMaker {
  const char* name;
  Maker make;
};

std::unique_ptr<const Codec> make_flat(const CodecOptions&, const BasisSet& directions) {
  return flat_codec(directions);
}

std::unique_ptr<const Codec> make_rnm(const CodecOptions& options, const BasisSet& directions) {
  return rnm_codec(options.name, directions);
}

constexpr std::array<NamedMaker, 7> makers{{{"flat", make_flat},
                                            {"rnm", make_rnm},
                                            {"rnm-vrad", make_rnm},
                                            {"rnm-bakery", make_rnm},
                                            {"sh2", lobe_codec},
                                            {"zh3", lobe_codec},
                                            {"geomerics", lobe_codec}}};

/// Tangent-space normals at which lobes are asked whether they are negative: upright, and tilted by 30 and 60
/// degrees.
const std::array<Vec3, 13>& probe_normals() {
  static const std::array<Vec3, 13> normals = [] {
    std::array<Vec3, 13> made{Vec3(0, 0, 1)};
    for (std::size_t i = 0; i < 6; ++i) {
      const double azimuth = static_cast<double>(i) * pi / 3;
      for (std::size_t ring = 0; ring < 2; ++ring) {
        const double tilt = static_cast<double>(ring + 1) * pi / 6;
        made[1 + 6 * ring + i] = Vec3(
            Vec3d(std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)));
      }
    }
    return made;
  }();
  return normals;
}

/// A number that no encoding's sums take out of float's range.
bool is_sound(const Vec3& v) {
  constexpr float greatest = 1e30F;
  return std::abs(v.x) <= greatest && std::abs(v.y) <= greatest && std::abs(v.z) <= greatest;
}

}  // namespace

EncodeCounts& EncodeCounts::operator+=(const EncodeCounts& other) {
  texels += other.texels;
  non_finite += other.non_finite;
  negative_lobes += other.negative_lobes;
  over_long += other.over_long;
  unconverged += other.unconverged;
  return *this;
}

EncodeCounts Codec::encode(std::span<const Vec3> irradiance, std::span<Vec3> layers,
                           const TexelFrame& frame) const {
  if (!std::ranges::all_of(irradiance, is_sound)) {
    const std::vector<Vec3> darkness(irradiance.size(), Vec3(0));
    EncodeCounts counts = encode_texel(darkness, layers, frame);
    counts.texels = counts.non_finite = 1;
    return counts;
  }
  EncodeCounts counts = encode_texel(irradiance, layers, frame);
  counts.texels = 1;
  float greatest = 0;
  for (const Vec3& light : irradiance) greatest = std::max(greatest, max_channel(light));
  const bool has_negative = std::ranges::any_of(probe_normals(), [&](const Vec3& normal) {
    const Vec3 light = decode(layers, frame.stored(normal));
    return std::min({light.x, light.y, light.z}) < -1e-3F * greatest;
  });
  counts.negative_lobes = has_negative ? 1 : 0;
  return counts;
}

std::vector<std::string> codec_names() {
  std::vector<std::string> names;
  for (const NamedMaker& maker : makers) names.emplace_back(maker.name);
  return names;
}

std::unique_ptr<const Codec> make_codec(const CodecOptions& options, const BasisSet& directions) {
  const auto* found =
      std::ranges::find_if(makers, [&](const NamedMaker& maker) { return maker.name == options.name; });
  if (found == makers.end()) {
    fail(ExitCode::usage, "there is no encoding '{}'; choose one of {}", options.name,
         fmt::join(codec_names(), ", "));
  }
  return found->make(options, directions);
}

std::size_t needed_direction(const BasisSet& set, const BasisDirection& wanted, const std::string& encoding) {
  if (const auto found = place_of(set, wanted)) return *found;
  fail(ExitCode::unsupported,
       "the encoding '{}' needs the bake '{}' of direction ({:.6f}, {:.6f}, {:.6f}), which '{}' does not "
       "hold; "
       "bake flat and the basis rnm",
       encoding, wanted.name, wanted.direction.x, wanted.direction.y, wanted.direction.z, set.name);
}

}  // namespace rnmbake
