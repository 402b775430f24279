// ssbump/generate_options.h - options of the methods that compute a height field's weights.
#pragma once

#include "image/float_image.h"

#include <cstdint>

namespace rnmbake {

/// horizon: the elevation of the horizon in some azimuths, integrated exactly above it. trace: rays, an
/// unbiased estimate of the same. cone: the visible share of a 120-degree cone about each axis, by rays
/// (Green's simple variant); power and bounces do not apply to it.
enum class SsbumpMethod : std::uint8_t { horizon, trace, cone };

struct GenerateOptions {
  SsbumpMethod method = SsbumpMethod::horizon;
  int azimuths = 0;  // horizon: directions in the plane; 0: 64 or as many (to 512) as `error` asks for
  int near_rows =
      0;  // horizon: rows about a texel where its surface is taken exactly; 0: 8, past 64 azimuths up to 32
  double error = 1e-3;  // horizon: RMSE over all texels and channels that is asked for; one value in 10,000
                        // may be off by more than 10 times that
  int rays = 250;       // trace, cone: for each texel
  double power = 1;     // of max(0, D . axis)
  int bounces = 0;      // light that other texels send back: how many reflections; by rays in any method
  float albedo = 0.5F;  // of the surface, where `albedo_map` is null
  const FloatImage* albedo_map = nullptr;  // first channel, of the height field's size
  std::uint64_t seed = 0;                  // of the rays
  int threads = 0;                         // 0: all cores
  std::uint64_t memory = 0;  // bytes that generate_rows() may take beside the heights; 0: a quarter of what
                             // the machine has, at least 2 GiB
};

}  // namespace rnmbake
