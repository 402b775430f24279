#include "lightmap/fill.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace rnmbake {
namespace {

template <typename Visit>
void for_each_neighbour(const FloatImage& image, std::size_t texel, Visit visit) {
  const int width = image.width(), height = image.height();
  const int x = static_cast<int>(texel % static_cast<std::size_t>(width));
  const int y = static_cast<int>(texel / static_cast<std::size_t>(width));
  for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, height - 1); ++ny) {
    for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, width - 1); ++nx) {
      if (nx != x || ny != y) visit(static_cast<std::size_t>(ny) * width + nx);
    }
  }
}

std::span<float> values_of(FloatImage& image, std::size_t texel) {
  const auto channels = static_cast<std::size_t>(image.channels());
  return {&image.data()[texel * channels], channels};
}

void take_mean_of_neighbours(FloatImage& image, std::size_t texel, const TexelMask& filled) {
  const auto values = values_of(image, texel);
  std::ranges::fill(values, 0.0F);
  float count = 0;
  for_each_neighbour(image, texel, [&](std::size_t neighbour) {
    if (filled[neighbour] == 0) return;
    const auto source = values_of(image, neighbour);
    for (std::size_t c = 0; c < values.size(); ++c) values[c] += source[c];
    ++count;
  });
  for (float& value : values) value /= count;
}

/// Fillable texels next to `sources` that are in no ring yet; `queued` remembers them.
std::vector<std::size_t> next_ring(const FloatImage& image, const std::vector<std::size_t>& sources,
                                   const TexelMask& filled, const TexelMask& fillable, TexelMask& queued) {
  std::vector<std::size_t> ring;
  for (const std::size_t source : sources) {
    for_each_neighbour(image, source, [&](std::size_t texel) {
      if (filled[texel] != 0 || fillable[texel] == 0 || queued[texel] != 0) return;
      queued[texel] = 1;
      ring.push_back(texel);
    });
  }
  return ring;
}

bool is_finite(std::span<const float> values) {
  return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}

}  // namespace

TexelMask covered_mask(const FloatImage& coverage) {
  TexelMask mask(coverage.texels());
  std::ranges::transform(coverage.data(), mask.begin(), [](float value) { return value > 0.5F ? 1 : 0; });
  return mask;
}

std::size_t fill_from_neighbours(FloatImage& image, TexelMask filled, const TexelMask& fillable,
                                 std::size_t passes) {
  std::vector<std::size_t> sources;
  for (std::size_t texel = 0; texel < filled.size(); ++texel)
    if (filled[texel] != 0) sources.push_back(texel);
  TexelMask queued(filled.size());
  std::size_t count = 0;
  for (std::size_t pass = 0; pass < passes; ++pass) {
    std::vector<std::size_t> ring = next_ring(image, sources, filled, fillable, queued);
    if (ring.empty()) break;
    for (const std::size_t texel : ring) take_mean_of_neighbours(image, texel, filled);
    for (const std::size_t texel : ring) filled[texel] = 1;
    count += ring.size();
    sources = std::move(ring);
  }
  return count;
}

void dilate(FloatImage& image, const FloatImage& coverage, int passes) {
  TexelMask filled = covered_mask(coverage), fillable(filled.size());
  for (std::size_t texel = 0; texel < filled.size(); ++texel) {
    fillable[texel] = filled[texel] == 0 ? 1 : 0;
    if (filled[texel] != 0 && !is_finite(values_of(image, texel))) filled[texel] = 0;
  }
  fill_from_neighbours(image, std::move(filled), fillable, static_cast<std::size_t>(std::max(passes, 0)));
}

void dilate_everywhere(FloatImage& image, const FloatImage& coverage) {
  dilate(image, coverage, std::max(coverage.width(), coverage.height()));
}

}  // namespace rnmbake
