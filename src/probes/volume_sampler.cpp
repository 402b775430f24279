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

/// The mean (over directions) and the flow of light out of harmonics of radiance, as zh3_lobe() takes them.
Vec3 zh3_of(std::span<const Vec3> harmonics, const Vec3& normal) {
  const auto along = [](const Vec3& axis) { return sh_irradiance_basis(axis); };
  static const float y0 = along({0, 0, 1})[0], y1 = along({0, 0, 1})[2];
  Vec3 light;
  for (int c = 0; c < 3; ++c) {
    const Vec3d v(double(harmonics[3][c]), double(harmonics[1][c]), double(harmonics[2][c]));
    light[c] =
        static_cast<float>(zh3_lobe(double(harmonics[0][c] * y0), v * double(y1), Vec3d(normal)).value);
  }
  return light;
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
    : volume_(volume), encoding_(encoding), test_(test), coefficients_(coefficients_of(encoding)), bias_(0) {
  if (!volume.grid)
    fail(ExitCode::unsupported, "'{}' is a list of points; only boxes of probes are interpolated",
         volume.name);
  if (test == LeakTest::visibility && volume.depths.side == 0) {
    fail(ExitCode::unsupported, "'{}' holds no distances to test visibility by; bake it with --depth",
         volume.name);
  }
  for (const LightProbe& probe : volume.probes) {
    const std::vector<Vec3> coefficients = encoded_probe(probe, encoding);
    values_.insert(values_.end(), coefficients.begin(), coefficients.end());
  }
  // A place on a surface lies behind the slant of a map's texels; off it, by a share of a cell, it does not.
  constexpr double share = 0.1;
  const auto& steps = volume.grid->steps;
  bias_ = share * std::min({steps[0].length(), steps[1].length(), steps[2].length()});
}

std::array<VolumeSampler::Corner, 8> VolumeSampler::corners(const Vec3d& place) const {
  const ProbeGrid& grid = *volume_.grid;
  const Vec3d at = grid.coordinates(place);
  std::array<int, 3> low{}, high{};
  std::array<float, 3> share{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double last = grid.counts[axis] - 1, x = std::clamp(at[int(axis)], 0.0, last);
    low[axis] = static_cast<int>(x);
    high[axis] = std::min(low[axis] + 1, grid.counts[axis] - 1);
    share[axis] = static_cast<float>(x - low[axis]);
  }
  std::array<Corner, 8> found;
  for (std::size_t k = 0; k < 8; ++k) {
    std::array<int, 3> cell{};
    float weight = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool is_high = (k >> axis & 1) != 0;
      cell[axis] = is_high ? high[axis] : low[axis];
      weight *= is_high ? share[axis] : 1 - share[axis];
    }
    found[k] = {grid.index(cell[0], cell[1], cell[2]), weight};
  }
  return found;
}

float VolumeSampler::leak_weight(std::size_t probe, const Vec3d& place, const Vec3& normal) const {
  if (test_ == LeakTest::none) return 1;
  if (!is_valid(volume_.probes[probe])) return 0;
  if (test_ == LeakTest::validity) return 1;
  const Vec3 from = Vec3(place + Vec3d(normal) * bias_ - volume_.probes[probe].position);
  const float distance = from.length();
  if (!(distance > 0)) return 1;
  const Vec3 direction = from / distance;
  const ProbeDepths& depths = volume_.depths;
  const auto side = static_cast<std::size_t>(depths.side);
  const Vec2 at = octahedral(direction);
  const auto texel = [&](float x) {
    return static_cast<std::size_t>(std::clamp(int((x + 1) / 2 * float(side)), 0, depths.side - 1));
  };
  const std::size_t i = (probe * side + texel(at.y)) * side + texel(at.x);
  return visible_share(distance, depths.mean[i], depths.square[i]);
}

Vec3 VolumeSampler::irradiance(const Vec3d& place, const Vec3& normal) const {
  std::array<Corner, 8> around = corners(place);
  const std::array<Corner, 8> trilinear = around;
  float sum = 0;
  for (Corner& corner : around) {
    if (corner.weight > 0) corner.weight *= leak_weight(corner.probe, place, normal);
    sum += corner.weight;
  }
  constexpr float least = 1e-5F;  // below, none of the probes knows anything of the place
  if (!(sum > least)) {
    around = trilinear;
    sum = 1;
  }
  std::array<Vec3, 9> blended;
  blended.fill(Vec3(0));
  for (const Corner& corner : around) {
    for (std::size_t c = 0; c < coefficients_; ++c)
      blended[c] += values_[corner.probe * coefficients_ + c] * (corner.weight / sum);
  }
  return decoded_probe(std::span(blended).first(coefficients_), encoding_, normal);
}

}  // namespace rnmbake
