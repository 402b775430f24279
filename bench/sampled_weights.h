// bench/sampled_weights.h - the weights of some texels of a map: the truth, and errors against it.
#pragma once

#include "ssbump/generate/hemisphere_rays.h"
#include "ssbump/height_fields.h"
#include "ssbump/heights/height_field.h"
#include "ssbump/heights/trace_heights.h"
#include "ssbump/map/weights.h"

#include <functional>
#include <vector>

namespace rnmbake {

struct Texel {
  int x = 0, y = 0;
};

/// Spread evenly over the map (Roberts' R2 sequence).
[[nodiscard]] std::vector<Texel> spread_texels(int width, int height, int count);

/// Weights of each texel by `weights`, in parallel.
[[nodiscard]] std::vector<Channels> for_each(const std::vector<Texel>& texels,
                                             const std::function<Channels(Texel)>& weights);

[[nodiscard]] std::vector<Channels> picked(const SsbumpWeights& weights, const std::vector<Texel>& texels);

/// Weights by rays into the bilinear surface.
[[nodiscard]] std::vector<Channels> by_rays(const HeightField& field, const std::vector<Texel>& texels,
                                            const std::vector<WeightedRay>& rays);

/// Weights by exact horizons in some azimuths.
[[nodiscard]] std::vector<Channels> by_horizons(const HeightField& field, const std::vector<Texel>& texels,
                                                int azimuths);

struct WeightErrors {
  double rmse = 0, largest = 0;
};

/// Over the first `channels`.
[[nodiscard]] WeightErrors errors_of(const std::vector<Channels>& found, const std::vector<Channels>& truth,
                                     std::size_t channels = SsbumpWeights::channels);

}  // namespace rnmbake
