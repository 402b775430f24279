#include "sampled_weights.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace rnmbake {
namespace {

Channels traced(const HeightTracer& tracer, Texel texel, const std::vector<WeightedRay>& rays) {
  const HeightPlace from = tracer.centre(texel.x, texel.y);
  Channels seen{}, whole{};
  for (const WeightedRay& ray : rays) {
    const bool open = !tracer.next(from, Vec3d(ray.direction));
    for (std::size_t c = 0; c < whole.size(); ++c) {
      whole[c] += double{ray.weight[c]};
      if (open) seen[c] += double{ray.weight[c]};
    }
  }
  for (std::size_t c = 0; c < whole.size(); ++c) seen[c] /= whole[c];
  return seen;
}

}  // namespace

std::vector<Texel> spread_texels(int width, int height, int count) {
  std::vector<Texel> texels;
  for (int i = 1; i <= count; ++i) {
    const auto at = [&](double step, int size) { return static_cast<int>(std::fmod(i * step, 1) * size); };
    texels.push_back({at(0.7548776662466927, width), at(0.5698402909980532, height)});
  }
  return texels;
}

std::vector<Channels> for_each(const std::vector<Texel>& texels,
                               const std::function<Channels(Texel)>& weights) {
  std::vector<Channels> all(texels.size());
  tbb::parallel_for(std::size_t{0}, texels.size(), [&](std::size_t i) { all[i] = weights(texels[i]); });
  return all;
}

std::vector<Channels> picked(const SsbumpWeights& weights, const std::vector<Texel>& texels) {
  return for_each(texels, [&](Texel texel) {
    Channels found;
    std::ranges::copy(weights.image.texel(texel.x, texel.y), found.begin());
    return found;
  });
}

std::vector<Channels> by_rays(const HeightField& field, const std::vector<Texel>& texels,
                              const std::vector<WeightedRay>& rays) {
  const HeightTracer tracer(field);
  return for_each(texels, [&](Texel texel) { return traced(tracer, texel, rays); });
}

std::vector<Channels> by_horizons(const HeightField& field, const std::vector<Texel>& texels, int azimuths) {
  const HeightRays surface(field);
  return for_each(texels, [&](Texel texel) { return exact_weights(surface, texel.x, texel.y, 1, azimuths); });
}

WeightErrors errors_of(const std::vector<Channels>& found, const std::vector<Channels>& truth,
                       std::size_t channels) {
  WeightErrors errors;
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t c = 0; c < channels; ++c) {
      const double error = std::abs(found[i][c] - truth[i][c]);
      errors.rmse += error * error;
      errors.largest = std::max(errors.largest, error);
    }
  }
  errors.rmse = std::sqrt(errors.rmse / double(found.size() * channels));
  return errors;
}

}  // namespace rnmbake
