// ssbump/height_fields.h - height fields for tests, and their exact weights.
#pragma once

#include "ssbump/heights/height_field.h"
#include "ssbump/heights/height_shadows.h"
#include "ssbump/map/lobes.h"

#include <array>
#include <cmath>
#include <random>

namespace rnmbake {

template <typename Function>
HeightField field_of(int width, int height, WrapMode beyond, const Function& at) {
  HeightField field{FloatImage(width, height, 1), beyond, beyond};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) field.heights.texel(x, y)[0] = static_cast<float>(at(x, y));
  return field;
}

/// Waves of all lengths that fit the tile, in random phases: as rough as stone. `range`: about max - min.
inline HeightField rough_field(int width, int height, WrapMode beyond, double range, unsigned seed = 1) {
  struct Wave {
    int x, y;
    double phase, size;
  };
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> phase(0, 2 * pi);
  std::uniform_int_distribution<int> number(-12, 12);
  std::vector<Wave> waves;
  for (int i = 0; i < 60; ++i) {
    const int x = number(random), y = number(random);
    waves.push_back({x, y, phase(random), 0.2 * range / (1 + std::hypot(x, y))});
  }
  return field_of(width, height, beyond, [&](int x, int y) {
    double sum = 0;
    for (const Wave& wave : waves)
      sum += wave.size *
             std::sin(2 * pi * (double(wave.x) * x / width + double(wave.y) * y / height) + wave.phase);
    return sum;
  });
}

using Channels = std::array<double, SsbumpWeights::channels>;

/// Out of exact horizons in `azimuths` directions.
inline Channels exact_weights(const HeightRays& surface, int x, int y, double power, int azimuths = 2048) {
  const auto lobes = ssbump_lobes(power);
  Channels seen{}, all{};
  for (int i = 0; i < azimuths; ++i) {
    const double angle = 2 * pi * (i + 0.5) / azimuths, cosine = std::cos(angle), sine = std::sin(angle);
    const Vec2 azimuth(static_cast<float>(cosine), static_cast<float>(sine));
    const double floor = 1e-3, slope = surface.horizon_slope(x, y, azimuth, floor);
    const double over = slope > floor ? slope / std::sqrt(1 + slope * slope) : 0;
    for (std::size_t c = 0; c < lobes.size(); ++c) {
      const double along = lobes[c].axis.x * cosine + lobes[c].axis.y * sine;
      seen[c] += lobe_above(along, lobes[c].axis.z, lobes[c].power, over);
      all[c] += lobe_above(along, lobes[c].axis.z, lobes[c].power, 0);
    }
  }
  for (std::size_t c = 0; c < all.size(); ++c) seen[c] /= all[c];
  return seen;
}

}  // namespace rnmbake
