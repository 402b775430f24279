#include "probes/volume_sampler.h"

#include "base/error.h"
#include "encoding/ambient_cube.h"
#include "encoding/codecs/ambient_cube_fit.h"
#include "encoding/sh.h"
#include "encoding/zh3.h"
#include "probes/fill_probes.h"
#include "sampling/octahedral.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

template <std::size_t N>
std::optional<std::size_t> place_in(const std::array<std::string_view, N>& names, std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

/// The mean (over directions) and the flow of light out of harmonics of radiance, as zh3_lobe() takes them.
Vec3 zh3_of(std::span<const Vec3> harmonics, const Vec3& normal) {
  const auto along = [](const Vec3& axis) { return sh_irradiance_basis(axis); };
  static const float y0 = along({0, 0, 1})[0], y1 = along({0, 0, 1})[2];
  Vec3 light;
  for (int c = 0; c < 3; ++c) {
    const Vec3d v{double(harmonics[3][c]), double(harmonics[1][c]), double(harmonics[2][c])};
    light[c] =
        static_cast<float>(zh3_lobe(double(harmonics[0][c] * y0), v * double(y1), Vec3d(normal)).value);
  }
  return light;
}

struct MeanDistance {
  float mean = 0, square = 0;
};

/// Bilinear between the texels of a probe's map. Beyond its border the map goes on mirrored: there two edges
/// of the unfolded sphere meet.
MeanDistance distances_at(const ProbeDepths& depths, std::size_t probe, const Vec3& direction) {
  const int side = depths.side;
  const Vec2 at = (octahedral(direction) + Vec2(1)) * (0.5F * float(side)) - Vec2(0.5F);
  const int left = static_cast<int>(std::floor(at.x)), top = static_cast<int>(std::floor(at.y));
  MeanDistance found;
  for (const int dy : {0, 1}) {
    for (const int dx : {0, 1}) {
      int x = left + dx, y = top + dy;
      const float weight = (1 - std::abs(at.x - float(x))) * (1 - std::abs(at.y - float(y)));
      if (x < 0 || x >= side) {
        x = std::clamp(x, 0, side - 1);
        y = side - 1 - y;
      }
      if (y < 0 || y >= side) {
        y = std::clamp(y, 0, side - 1);
        x = side - 1 - x;
      }
      const std::size_t i = (probe * std::size_t(side) + std::size_t(y)) * std::size_t(side) + std::size_t(x);
      found.mean += weight * depths.mean[i];
      found.square += weight * depths.square[i];
    }
  }
  return found;
}

/// Share of a probe in the light of a place at `distance`, where rays in that direction go `mean` far:
/// Chebyshev's bound on the share of rays that go farther. Donnelly and Lauritzen, "Variance Shadow Maps"
/// (I3D 2006); for probes Majercik et al., "Dynamic Diffuse Global Illumination with Ray-Traced Irradiance
/// Fields" (JCGT 2019), who take its cube, too.
float visible_share(float distance, float mean, float square) {
  if (distance <= mean) return 1;
  const float variance = std::max(square - mean * mean, 0.0F), beyond = distance - mean;
  const float bound = variance / (variance + beyond * beyond);
  return bound * bound * bound;
}

/// Throws Error(unsupported) where it is none.
const ProbeVolume& box_of(const ProbeVolume& volume) {
  if (!volume.grid)
    fail(ExitCode::unsupported, "'{}' is a list of points; only boxes of probes are interpolated",
         volume.name);
  return volume;
}

}  // namespace

std::optional<ProbeEncoding> probe_encoding_of(std::string_view name) {
  const auto place = place_in(probe_encoding_names, name);
  if (!place) return std::nullopt;
  return static_cast<ProbeEncoding>(*place);
}

std::optional<LeakTest> leak_test_of(std::string_view name) {
  const auto place = place_in(leak_test_names, name);
  if (!place) return std::nullopt;
  return static_cast<LeakTest>(*place);
}

std::vector<LeakTest> leak_tests_for(std::span<const ProbeVolume> volumes) {
  std::vector<LeakTest> tests{LeakTest::none, LeakTest::validity};
  const bool have_distances = std::ranges::all_of(
      volumes, [](const ProbeVolume& volume) { return !volume.grid || volume.depths.side > 0; });
  if (have_distances) tests.push_back(LeakTest::visibility);
  return tests;
}

std::size_t coefficients_of(ProbeEncoding encoding) {
  switch (encoding) {
    case ProbeEncoding::cube:
    case ProbeEncoding::cube_fit:
      return 6;
    case ProbeEncoding::sh2:
    case ProbeEncoding::zh3:
      return 4;
    case ProbeEncoding::sh3:
      break;
  }
  return 9;
}

std::vector<Vec3> encoded_probe(const LightProbe& probe, ProbeEncoding encoding) {
  if (encoding == ProbeEncoding::cube) return {probe.irradiance.begin(), probe.irradiance.begin() + 6};
  if (encoding == ProbeEncoding::cube_fit) {
    const AmbientCube cube =
        fit_ambient_cube(probe_directions(), probe.irradiance, probe_direction_weights());
    return {cube.begin(), cube.end()};
  }
  const auto count = static_cast<std::ptrdiff_t>(coefficients_of(encoding));
  return {probe.harmonics.begin(), probe.harmonics.begin() + count};
}

Vec3 decoded_probe(std::span<const Vec3> coefficients, ProbeEncoding encoding, const Vec3& normal) {
  switch (encoding) {
    case ProbeEncoding::cube:
    case ProbeEncoding::cube_fit: {
      AmbientCube cube;
      std::copy_n(coefficients.begin(), cube.size(), cube.begin());
      return ambient_cube_decode(cube, normal);
    }
    case ProbeEncoding::zh3:
      return zh3_of(coefficients, normal);
    case ProbeEncoding::sh2:
    case ProbeEncoding::sh3:
      break;
  }
  return irradiance_of(coefficients, normal);
}

VolumeSampler::VolumeSampler(const ProbeVolume& volume, ProbeEncoding encoding, LeakTest test)
    : volume_(box_of(volume)),
      encoding_(encoding),
      test_(test),
      coefficients_(coefficients_of(encoding)),
      cells_(volume) {
  if (test == LeakTest::visibility && volume.depths.side == 0) {
    fail(ExitCode::unsupported, "'{}' holds no distances to test visibility by; it was made with --no-depth",
         volume.name);
  }
  for (const LightProbe& probe : volume.probes) {
    const std::vector<Vec3> coefficients = encoded_probe(probe, encoding);
    values_.insert(values_.end(), coefficients.begin(), coefficients.end());
  }
  // A place on a surface lies behind the slant of a map's texels; off it, by a share of a cell, it does not.
  // The cell is the probe's smallest: were it the place's, light would jump where large cells meet small
  // ones.
  constexpr double share = 0.1;
  for (std::size_t i = 0; i < volume.probes.size(); ++i) biases_.push_back(share * cells_.least_step(i));
}

float VolumeSampler::leak_weight(std::size_t probe, const Vec3d& place, const Vec3& normal) const {
  if (test_ == LeakTest::none) return 1;
  if (!is_valid(volume_.probes[probe])) return 0;
  if (test_ == LeakTest::validity) return 1;
  const Vec3 from = Vec3(place + Vec3d(normal) * biases_[probe] - volume_.probes[probe].position);
  const float distance = from.length();
  if (!(distance > 0)) return 1;
  const Vec3 direction = from / distance;
  const auto [mean, square] = distances_at(volume_.depths, probe, direction);
  return visible_share(distance, mean, square);
}

ProbeShares VolumeSampler::shares(const Vec3d& place, const Vec3& normal) const {
  const ProbeShares trilinear = cells_.around(place);
  ProbeShares seen = trilinear;
  float sum = 0;
  for (ProbeShare& share : seen.used()) {
    share.weight *= leak_weight(share.probe, place, normal);
    sum += share.weight;
  }
  constexpr float least = 1e-5F;  // below, none of the probes knows anything of the place
  if (!(sum > least)) return trilinear;
  for (ProbeShare& share : seen.used()) share.weight /= sum;
  return seen;
}

Vec3 VolumeSampler::irradiance(const Vec3d& place, const Vec3& normal) const {
  std::array<Vec3, 9> blended;
  blended.fill(Vec3(0));
  const ProbeShares around = shares(place, normal);
  for (const ProbeShare& share : around.used()) {
    for (std::size_t c = 0; c < coefficients_; ++c)
      blended[c] += values_[share.probe * coefficients_ + c] * share.weight;
  }
  return decoded_probe(std::span(blended).first(coefficients_), encoding_, normal);
}

}  // namespace rnmbake
