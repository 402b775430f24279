#include "closed_forms/cases.h"

#include "base/error.h"
#include "base/math.h"
#include "lightmap/metadata.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

namespace rnmbake {
namespace {

/// A square lamp of radiance 1 one metre above: E of flat and of the bases in units of irradiance (polygon
/// clipped to the surface's horizon and to the basis vector's; Lambert's formula).
struct LampIrradiance {
  double flat, rnm0, rnm1, rnm2;

  double operator()(const BasisDirection& basis) const {
    const double irradiance = basis.name == "flat"   ? flat
                              : basis.name == "rnm0" ? rnm0
                              : basis.name == "rnm1" ? rnm1
                                                     : rnm2;
    return irradiance / pi;
  }
};
const LampIrradiance lamp_one{1.74083950, 1.02119225, 1.02492043, 1.02492043};
const LampIrradiance lamp_half{0.75227469, 0.43432599, 0.43432599, 0.43432599};

/// Radiance `level` from everywhere above.
std::function<double(const BasisDirection&)> uniform_light(double level) {
  return [level](const BasisDirection& basis) { return level * (1 + double(basis.direction.z)) / 2; };
}

Words effort(int resolution, int samples, int bounces) {
  return {"--resolution", std::to_string(resolution), "--samples", std::to_string(samples),
          "--bounces",    std::to_string(bounces)};
}

/// Errors over a square of texels.
struct Tile {
  double error = 0, texels = 0;
};

/// Of the mean over all tiles, from the spread over them: a ratio estimator's.
double standard_error_of(const std::map<std::pair<int, int>, Tile>& tiles, double mean_error, double texels) {
  double squares = 0;
  for (const auto& [place, tile] : tiles) squares += std::pow(tile.error - mean_error * tile.texels, 2);
  const auto count = double(tiles.size());
  return std::sqrt(squares * count / (count - 1)) / texels;
}

/// `tile_side`: texels closer than that may have their noise in common.
Outcome compare_layer(const Layer& layer, const FloatImage& coverage, const BasisDirection& basis,
                      double expected, int tile_side) {
  Outcome outcome{basis.name, expected};
  std::map<std::pair<int, int>, Tile> tiles;
  double sum = 0;
  for (int y = 0; y < coverage.height(); ++y) {
    for (int x = 0; x < coverage.width(); ++x) {
      if (coverage.texel(x, y)[0] == 0) continue;
      const double error = double(layer.pixels.texel(x, y)[0]) - expected;
      sum += error;
      Tile& tile = tiles[{y / tile_side, x / tile_side}];
      tile.error += error;
      tile.texels += 1;
      outcome.largest = std::max(outcome.largest, std::abs(error));
      ++outcome.texels;
    }
  }
  const double n = double(outcome.texels), mean_error = sum / n;
  outcome.mean = expected + mean_error;
  outcome.standard_error = standard_error_of(tiles, mean_error, n);
  return outcome;
}

/// The tracer gathers blocks of neighbouring texels with the same paths; Cycles' texels are on their own.
int tile_side_of(const LayeredImage& lightmap) {
  const std::string recipe = read_metadata(lightmap, "lightmap").recipe;
  return recipe == "reference" || recipe == "traced" ? 8 : 1;
}

}  // namespace

double Outcome::allowance() const {
  return std::max(0.002 * expected, 3 * standard_error);
}

const std::vector<BasisDirection>& baked_bases() {
  static const std::vector<BasisDirection> bases = [] {
    std::vector<BasisDirection> list{flat_direction()};
    for (const BasisDirection& basis : rnm_set().directions) list.push_back(basis);
    return list;
  }();
  return bases;
}

std::vector<Outcome> compare(const LayeredImage& lightmap,
                             const std::function<double(const BasisDirection&)>& truth) {
  std::vector<Outcome> outcomes;
  const Layer* coverage = lightmap.find("coverage");
  for (const BasisDirection& basis : baked_bases()) {
    const Layer* layer = lightmap.find(basis.name == "flat" ? "" : basis.name);
    if (layer == nullptr || coverage == nullptr)
      fail(ExitCode::tasks_failed, "the lightmap has no layer for {}", basis.name);
    outcomes.push_back(compare_layer(*layer, coverage->pixels, basis, truth(basis), tile_side_of(lightmap)));
  }
  return outcomes;
}

std::vector<UniformCase> uniform_cases() {
  return {
      {"Sky", "uniform sky", {"plane_sky", {}}, "plane", effort(32, 256, 0), uniform_light(1)},
      {"LampOne", "lamp, half size 1", {"plane_lamp", {"half=1"}}, "plane", effort(32, 1024, 0), lamp_one},
      {"LampHalf",
       "lamp, half size 0.5",
       {"plane_lamp", {"half=0.5"}},
       "plane",
       effort(32, 1024, 0),
       lamp_half},
      {"FurnaceHalf",
       "furnace, albedo 0.5",
       {"furnace", {"albedo=0.5"}},
       "furnace",
       effort(32, 128, 24),
       uniform_light(1 / (1 - 0.5))},
      {"FurnaceBright",
       "furnace, albedo 0.8",
       {"furnace", {"albedo=0.8"}},
       "furnace",
       effort(32, 256, 64),
       uniform_light(1 / (1 - 0.8))},
  };
}

std::string SunCase::object() const {
  return fmt::format("{}sun_{:g}_{}", prefix, angle, azimuth);
}

double SunCase::truth(const BasisDirection& basis) const {
  if (angle >= 90) return 0;
  const Vec3d to_sun = direction_at(angle * pi / 180, azimuth * pi / 180);
  return std::max(0.0, to_sun.dot(Vec3d(basis.direction)));
}

std::vector<SunCase> plain_suns() {
  std::vector<SunCase> suns;
  for (const double angle : sun_angles) {
    for (const int azimuth : sun_azimuths) suns.push_back({"", angle, azimuth});
  }
  return suns;
}

std::vector<SunCase> unusual_suns() {
  std::vector<SunCase> suns;
  for (const char* prefix : {"tiny_", "scaled_", "mirrored_", "mirroruv_", "far_"}) {
    for (const double angle : {54.7, 70.0}) {
      for (const int azimuth : sun_azimuths) suns.push_back({prefix, angle, azimuth});
    }
  }
  return suns;
}

Words sun_flags() {
  return effort(16, 16, 0);
}

}  // namespace rnmbake
