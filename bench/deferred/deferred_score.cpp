#include "deferred_score.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace rnmbake {
namespace {

std::size_t pixel_at(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

/// 1 where a neighbour to the right or below is another object's and lies farther or nearer by the jump, and
/// at that neighbour.
std::vector<std::uint8_t> silhouettes(const GBuffer& gbuffer) {
  const int width = gbuffer.depth.width(), height = gbuffer.depth.height();
  std::vector<std::uint8_t> result(gbuffer.depth.texels());
  const auto compare = [&](std::size_t a, std::size_t b) {
    const bool jumps = gbuffer.object.data()[a] != gbuffer.object.data()[b] &&
                       std::abs(gbuffer.depth.data()[a] - gbuffer.depth.data()[b]) > Regions::jump;
    if (jumps) result[a] = result[b] = 1;
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto i = pixel_at(x, y, width);
      if (x + 1 < width) compare(i, i + 1);
      if (y + 1 < height) compare(i, i + static_cast<std::size_t>(width));
    }
  }
  return result;
}

/// All pixels within `radius` of a marked one.
std::vector<std::uint8_t> grown(const std::vector<std::uint8_t>& marked, int width, int height, int radius) {
  std::vector<std::uint8_t> result(marked.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (marked[pixel_at(x, y, width)] == 0) continue;
      for (int v = std::max(0, y - radius); v <= std::min(height - 1, y + radius); ++v)
        for (int u = std::max(0, x - radius); u <= std::min(width - 1, x + radius); ++u)
          if ((u - x) * (u - x) + (v - y) * (v - y) <= radius * radius) result[pixel_at(u, v, width)] = 1;
    }
  }
  return result;
}

std::string percent_of(double part, double whole, int digits) {
  return whole > 0 ? fmt::format("{:.{}f}", 100 * part / whole, digits) : "-";
}

}  // namespace

Regions::Regions(const GBuffer& gbuffer, float character) {
  const FloatImage& object = gbuffer.object;
  const auto band = grown(silhouettes(gbuffer), object.width(), object.height(), band_pixels);
  for (auto& region : in_) region.resize(object.texels());
  for (std::size_t i = 0; i < object.texels(); ++i) {
    const bool is_character = object.data()[i] == character;
    const bool is_world = object.data()[i] > 0 && !is_character;
    in_[0][i] = is_world ? 1 : 0;
    in_[1][i] = is_world ? band[i] : 0;
    in_[2][i] = is_character ? 1 : 0;
  }
}

double Regions::share(std::size_t region) const {
  return static_cast<double>(std::ranges::count(in_[region], 1)) / static_cast<double>(in_[region].size());
}

void DeferredScore::add(double cosine, double truth, double left) {
  count += 1;
  const bool is_lit = truth > 0.5, called_lit = left > 0.5;
  (is_lit ? lit : shadowed) += 1;
  if (is_lit && !called_lit) falsely += 1;
  if (!is_lit && !called_lit) found += 1;
  squares += cosine * cosine * (left - truth) * (left - truth);
}

DeferredScore& DeferredScore::operator+=(const DeferredScore& other) {
  for (auto member : {&DeferredScore::count, &DeferredScore::lit, &DeferredScore::shadowed,
                      &DeferredScore::falsely, &DeferredScore::found, &DeferredScore::squares})
    this->*member += other.*member;
  return *this;
}

RegionScores& RegionScores::operator+=(const RegionScores& other) {
  for (std::size_t region = 0; region < Regions::count; ++region) scores[region] += other.scores[region];
  return *this;
}

void RegionScores::add(const Regions& regions, const LitPixels& lit, const FloatImage& left) {
  for (std::size_t i = 0; i < left.texels(); ++i) {
    const double cosine = lit.cosine.data()[i] * lit.seen.data()[i];
    if (cosine <= 0) continue;
    for (std::size_t region = 0; region < Regions::count; ++region)
      if (regions.contains(region, i)) scores[region].add(cosine, lit.truth.data()[i], left.data()[i]);
  }
}

std::string heading(const Regions& regions) {
  return fmt::format(
      "| | RMSE, static world | falsely % | found % | RMSE, band ({:.0f} % of the picture) | falsely % | "
      "found % | "
      "falsely %, figure |\n|---|---|---|---|---|---|---|---|\n",
      100 * regions.share(1));
}

std::string shadowed_share(const RegionScores& scores) {
  const DeferredScore& world = scores.scores[0];
  return fmt::format("\nOf the lit pixels of the static world {} % lie in a shadow of its relief.\n",
                     percent_of(world.shadowed, world.count, 1));
}

std::string elevation_heading(std::span<const double> degrees) {
  std::string names = "\n| in the band |", line = "|---|";
  for (const double one : degrees) {
    names += fmt::format(" RMSE, {:g} degrees | falsely % |", one);
    line += "---|---|";
  }
  return names + "\n" + line + "\n";
}

std::string band_cells(std::span<const RegionScores> by_elevation) {
  std::string text;
  for (const RegionScores& scores : by_elevation) {
    const DeferredScore& band = scores.scores[1];
    text += fmt::format("{:.3f} | {} | ", std::sqrt(band.squares / band.count),
                        percent_of(band.falsely, band.lit, 2));
  }
  return text.substr(0, text.size() - 1);
}

std::string cells(const RegionScores& scores) {
  std::string text;
  for (const std::size_t region : {std::size_t(0), std::size_t(1)}) {
    const DeferredScore& score = scores.scores[region];
    text += fmt::format("{:.3f} | {} | {} | ", std::sqrt(score.squares / score.count),
                        percent_of(score.falsely, score.lit, 2), percent_of(score.found, score.shadowed, 1));
  }
  return text + percent_of(scores.scores[2].falsely, scores.scores[2].lit, 2) + " |";
}

}  // namespace rnmbake
