#include "lightmap/faults.h"

#include "lightmap/fill.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace rnmbake {
namespace {

/// Mean of the channels of a covered texel; NaN where it is not finite or not covered.
std::vector<float> brightness_of(const FloatImage& radiance, const TexelMask& covered) {
  const auto channels = static_cast<std::size_t>(radiance.channels());
  std::vector<float> result(covered.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t texel = 0; texel < covered.size(); ++texel) {
    if (covered[texel] == 0) continue;
    const std::span values(&radiance.data()[texel * channels], channels);
    const float mean = std::accumulate(values.begin(), values.end(), 0.0F) / static_cast<float>(channels);
    if (std::isfinite(mean)) result[texel] = mean;
  }
  return result;
}

float median_of(std::vector<float> values) {
  std::erase_if(values, [](float value) { return std::isnan(value); });
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

bool outshines_neighbours(const std::vector<float>& brightness, int width, int height, int x, int y) {
  const auto at = [&](int column, int row) {
    return brightness[static_cast<std::size_t>(row) * width + column];
  };
  int sound = 0;
  float brightest = 0;
  for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, height - 1); ++ny) {
    for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, width - 1); ++nx) {
      if ((nx == x && ny == y) || std::isnan(at(nx, ny))) continue;
      ++sound;
      brightest = std::max(brightest, at(nx, ny));
    }
  }
  return sound >= 2 && at(x, y) > firefly_ratio * brightest;
}

}  // namespace

std::vector<TexelFault> find_faults(const FloatImage& radiance, const FloatImage& coverage) {
  const TexelMask covered = covered_mask(coverage);
  const std::vector<float> brightness = brightness_of(radiance, covered);
  const float median = median_of(brightness);
  std::vector<TexelFault> faults(covered.size(), TexelFault::none);
  std::size_t texel = 0;
  for (int y = 0; y < radiance.height(); ++y) {
    for (int x = 0; x < radiance.width(); ++x, ++texel) {
      if (covered[texel] == 0) continue;
      if (std::isnan(brightness[texel])) {
        faults[texel] = TexelFault::non_finite;
      } else if (brightness[texel] > firefly_ratio * median &&
                 outshines_neighbours(brightness, radiance.width(), radiance.height(), x, y)) {
        faults[texel] = TexelFault::firefly;
      }
    }
  }
  return faults;
}

std::size_t repair_faults(FloatImage& radiance, const FloatImage& coverage,
                          const std::vector<TexelFault>& faults) {
  const auto channels = static_cast<std::ptrdiff_t>(radiance.channels());
  TexelMask sound = covered_mask(coverage), fillable(sound.size());
  std::size_t count = 0;
  for (std::size_t texel = 0; texel < sound.size(); ++texel) {
    if (faults[texel] == TexelFault::none) continue;
    sound[texel] = 0;
    fillable[texel] = 1;
    ++count;
    std::fill_n(radiance.data().begin() + static_cast<std::ptrdiff_t>(texel) * channels, channels, 0.0F);
  }
  fill_from_neighbours(radiance, std::move(sound), fillable, faults.size());
  return count;
}

}  // namespace rnmbake
