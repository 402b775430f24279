#include "lightmap/merge.h"

#include "base/error.h"
#include "encoding/encodings.h"
#include "lightmap/faults.h"
#include "lightmap/fill.h"
#include "lightmap/half_range.h"
#include "lightmap/normalize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

namespace rnmbake {
namespace {

void check_picture(const FloatImage& image, const FloatImage& coverage, int least_channels,
                   const std::string& name) {
  if (image.width() == coverage.width() && image.height() == coverage.height() &&
      image.channels() >= least_channels)
    return;
  fail(ExitCode::invalid_input,
       "the bake of '{}' is {}x{} with {} channels where {}x{} with {} was expected; bake again", name,
       image.width(), image.height(), image.channels(), coverage.width(), coverage.height(), least_channels);
}

void check(const TargetBakes& bakes) {
  if (bakes.bases.empty() || bakes.coverage.empty()) {
    fail(ExitCode::invalid_input,
         "there is nothing to merge: no basis or an empty coverage; bake at least one basis");
  }
  check_picture(bakes.coverage, bakes.coverage, 1, "coverage");
  for (const BasisBake& basis : bakes.bases) check_picture(basis.radiance, bakes.coverage, 3, basis.name);
  if (!bakes.tangent.empty()) check_picture(bakes.tangent, bakes.coverage, 3, "tangent");
  if (!bakes.normal.empty()) check_picture(bakes.normal, bakes.coverage, 3, "normal");
}

/// The first `channels` channels, 0 where nothing is covered: bakers leave anything there.
FloatImage covered_part(const FloatImage& image, const TexelMask& covered, int channels) {
  FloatImage result(image.width(), image.height(), channels);
  for (std::size_t texel = 0; texel < covered.size(); ++texel) {
    if (covered[texel] == 0) continue;
    for (int c = 0; c < channels; ++c)
      result.data()[texel * channels + c] = image.data()[texel * image.channels() + c];
  }
  return result;
}

FloatImage binary(const TexelMask& covered, int width, int height) {
  FloatImage image(width, height, 1);
  std::ranges::copy(covered, image.data().begin());
  return image;
}

struct Colours {
  std::vector<BasisBake> bases;  // radiance without what lies outside the coverage
  FloatImage coverage;
  TexelMask covered;

  [[nodiscard]] FloatImage* find(std::string_view name) {
    const auto found = std::ranges::find(bases, name, &BasisBake::name);
    return found == bases.end() ? nullptr : &found->radiance;
  }
};

Colours colours_of(const TargetBakes& bakes) {
  Colours colours;
  colours.covered = covered_mask(bakes.coverage);
  colours.coverage = binary(colours.covered, bakes.coverage.width(), bakes.coverage.height());
  for (const BasisBake& basis : bakes.bases)
    colours.bases.push_back({basis.name, basis.direction, covered_part(basis.radiance, colours.covered, 3)});
  return colours;
}

std::size_t count_set(const TexelMask& mask) {
  return mask.size() - static_cast<std::size_t>(std::ranges::count(mask, 0));
}

void count_values(const Colours& colours, MergeCounts& counts) {
  TexelMask lit(colours.covered.size());
  for (const BasisBake& basis : colours.bases) {
    const auto& data = basis.radiance.data();
    for (std::size_t i = 0; i < data.size(); ++i) {
      if (data[i] != 0) lit[i / 3] = 1;
      if (data[i] < 0 && std::isfinite(data[i])) ++counts.negative;
    }
  }
  counts.covered_texels = count_set(colours.covered);
  counts.black = counts.covered_texels - count_set(lit);
}

void treat_faults(Colours& colours, bool repair, MergeCounts& counts) {
  TexelMask non_finite(colours.covered.size()), firefly(non_finite), repaired(non_finite);
  for (BasisBake& basis : colours.bases) {
    const auto faults = find_faults(basis.radiance, colours.coverage);
    for (std::size_t texel = 0; texel < faults.size(); ++texel) {
      if (faults[texel] == TexelFault::non_finite) non_finite[texel] = 1;
      if (faults[texel] == TexelFault::firefly) firefly[texel] = 1;
      if (repair && faults[texel] != TexelFault::none) repaired[texel] = 1;
    }
    if (repair) repair_faults(basis.radiance, colours.coverage, faults);
  }
  counts.non_finite = count_set(non_finite);
  counts.fireflies = count_set(firefly);
  counts.repaired = count_set(repaired);
}

void normalize(Colours& colours, MergeCounts& counts) {
  const FloatImage* flat = colours.find(flat_layers.front());
  const std::array<FloatImage*, 3> maps{colours.find(rnm_layers[0]), colours.find(rnm_layers[1]),
                                        colours.find(rnm_layers[2])};
  if (flat == nullptr || std::ranges::count(maps, nullptr) > 0) {
    fail(ExitCode::usage,
         "normalize flat needs the flat bake and all of rnm0, rnm1, rnm2; add them or choose none");
  }
  counts.unscalable = normalize_to_flat(maps, *flat);
}

void add_frames(const TargetBakes& bakes, const TexelMask& covered, LayeredImage& image) {
  if (!bakes.tangent.empty()) {
    const bool has_sign = bakes.tangent.channels() > 3;
    const std::vector<std::string> names{"X", "Y", "Z", "S"};
    const int channels = has_sign ? 4 : 3;
    image.layers.push_back({"tangent",
                            {names.begin(), names.begin() + channels},
                            covered_part(bakes.tangent, covered, channels)});
  }
  if (!bakes.normal.empty())
    image.layers.push_back({"normal", {"X", "Y", "Z"}, covered_part(bakes.normal, covered, 3)});
}

}  // namespace

MergedLightmap merge(const TargetBakes& bakes, const MergeOptions& options) {
  check(bakes);
  Colours colours = colours_of(bakes);
  MergedLightmap merged;
  count_values(colours, merged.counts);
  treat_faults(colours, options.repair, merged.counts);
  if (options.normalize == Normalize::flat) normalize(colours, merged.counts);
  for (BasisBake& basis : colours.bases) {
    if (options.depth == Depth::half) merged.counts.beyond_half += clamp_to_half(basis.radiance);
    dilate(basis.radiance, colours.coverage, options.dilate);
    merged.image.layers.push_back({exr_layer(basis.name), {"R", "G", "B"}, std::move(basis.radiance)});
  }
  std::ranges::stable_sort(merged.image.layers, {},
                           [](const Layer& layer) { return layer.name.empty() ? 0 : 1; });
  add_frames(bakes, colours.covered, merged.image);
  merged.image.layers.push_back({"coverage", {""}, std::move(colours.coverage)});
  return merged;
}

}  // namespace rnmbake
