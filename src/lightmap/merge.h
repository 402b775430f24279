// lightmap/merge.h - per-basis bakes of one target become one lightmap.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "image/bakes.h"
#include "image/layered_exr.h"

namespace rnmbake {

enum class Normalize { none, flat };

struct MergeOptions {
  Normalize normalize = Normalize::none;
  int dilate = 4;        // texels; 0 = off
  bool repair = false;   // replace non-finite texels and fireflies from their neighbours
  Depth depth = Depth::half;
};

/// What the merge saw; goes into the manifest.
struct MergeCounts {
  std::size_t covered_texels = 0;
  std::size_t non_finite = 0;     // texels with NaN or Inf in any basis, before repair
  std::size_t fireflies = 0;      // texels far above all their neighbours in any basis
  std::size_t repaired = 0;
  std::size_t beyond_half = 0;    // values clamped to 65504 (depth half only)
  std::size_t black = 0;          // covered texels that are exactly 0 in every basis
};

struct MergedLightmap {
  LayeredImage image; // layers "" (flat), rnm0.., coverage, and tangent / normal where given
  MergeCounts counts;
};

/// Counts, repairs, normalizes, dilates, clamps. Coverage itself is never dilated.
/// Throws Error(invalid_input) where the images differ in size or no basis was given.
[[nodiscard]] MergedLightmap merge(const TargetBakes& bakes, const MergeOptions& options);

}  // namespace rnmbake
