// bench/deferred/deferred_score.h - how near deferred shadows are to the exact ones, over all pixels and
// beside silhouettes.
#pragma once

#include "deferred_scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rnmbake {

/// Pixels of the static world; those of them in a band about silhouettes, where depth jumps; the character's.
class Regions {
 public:
  static constexpr int band_pixels = 24;
  static constexpr float jump = 0.1F;  // in depth, between pixels of two objects
  static constexpr std::size_t count = 3;

  Regions(const GBuffer& gbuffer, float character);

  [[nodiscard]] bool contains(std::size_t region, std::size_t pixel) const { return in_[region][pixel] != 0; }
  [[nodiscard]] double share(std::size_t region) const;  // of all pixels

 private:
  std::array<std::vector<std::uint8_t>, count> in_;
};

/// Sums over pixels that the light's cosine and the other surfaces leave lit.
struct DeferredScore {
  double count = 0, lit = 0, shadowed = 0, falsely = 0, found = 0, squares = 0;

  void add(double cosine, double truth, double left);
  DeferredScore& operator+=(const DeferredScore& other);
};

struct RegionScores {
  std::array<DeferredScore, Regions::count> scores;

  void add(const Regions& regions, const LitPixels& lit, const FloatImage& left);
  RegionScores& operator+=(const RegionScores& other);
};

/// The head of the table, as Markdown.
[[nodiscard]] std::string heading(const Regions& regions);
[[nodiscard]] std::string cells(const RegionScores& scores);

/// A sentence on how much of the static world is in shadow.
[[nodiscard]] std::string shadowed_share(const RegionScores& scores);

/// The same of a table of the band alone, two columns for each elevation of the light.
[[nodiscard]] std::string elevation_heading(std::span<const double> degrees);
[[nodiscard]] std::string band_cells(std::span<const RegionScores> by_elevation);

}  // namespace rnmbake
