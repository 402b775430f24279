#include "encoding/codec.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rnmbake {
namespace {

/// Tangent-space normals at which lobes are asked whether they are negative: upright, and tilted by 30 and 60
/// degrees.
const std::array<Vec3, 13>& probe_normals() {
  static const std::array<Vec3, 13> normals = [] {
    std::array<Vec3, 13> made{Vec3(0, 0, 1)};
    for (std::size_t i = 0; i < 6; ++i) {
      const double azimuth = static_cast<double>(i) * pi / 3;
      for (std::size_t ring = 0; ring < 2; ++ring) {
        made[1 + 6 * ring + i] = Vec3(direction_at(static_cast<double>(ring + 1) * pi / 6, azimuth));
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
  out_of_range += other.out_of_range;
  unconverged += other.unconverged;
  return *this;
}

void Codec::encode(const Texels& texels, std::span<EncodeCounts> counts) const {
  std::ranges::fill(counts, EncodeCounts{.texels = 1});
  std::vector<Vec3> irradiance(texels.irradiance.begin(), texels.irradiance.end());
  for (std::size_t i = 0; i < texels.count(); ++i) {
    if (std::ranges::all_of(texels.irradiance_of(i), is_sound)) continue;
    const std::size_t directions = irradiance.size() / texels.count();
    std::fill_n(irradiance.begin() + static_cast<std::ptrdiff_t>(i * directions), directions, Vec3(0));
    counts[i].non_finite = 1;
  }
  const Texels sound{irradiance, texels.layers, texels.frames};
  encode_texels(sound, counts);
  for (std::size_t i = 0; i < texels.count(); ++i) {
    if (is_negative(sound.irradiance_of(i), sound.layers_of(i), sound.frames[i]))
      counts[i].negative_lobes = 1;
  }
}

EncodeCounts Codec::encode(std::span<const Vec3> irradiance, std::span<Vec3> layers,
                           const TexelFrame& frame) const {
  EncodeCounts counts;
  encode({irradiance, layers, {&frame, 1}}, {&counts, 1});
  return counts;
}

bool Codec::is_negative(std::span<const Vec3> irradiance, std::span<const Vec3> layers,
                        const TexelFrame& frame) const {
  float greatest = 0;
  for (const Vec3& light : irradiance) greatest = std::max(greatest, max_channel(light));
  const float limit = -1e-3F * greatest;
  if (least_light(layers, frame) >= limit / 2) return false;  // half: what floats round is far less
  return std::ranges::any_of(probe_normals(), [&](const Vec3& normal) {
    const Vec3 light = decode(layers, frame.stored(normal));
    return std::min({light.x, light.y, light.z}) < limit;
  });
}

double Codec::least_light(std::span<const Vec3>, const TexelFrame&) const {
  return -std::numeric_limits<double>::infinity();
}

void TexelCodec::encode_texels(const Texels& texels, std::span<EncodeCounts> counts) const {
  for (std::size_t i = 0; i < texels.count(); ++i)
    counts[i] += encode_texel(texels.irradiance_of(i), texels.layers_of(i), texels.frames[i]);
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
