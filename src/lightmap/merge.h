// lightmap/merge.h - per-basis bakes of one target become one lightmap.
#pragma once

#include "base/numeric/stored_values.h"
#include "image/bakes.h"
#include "image/layered_exr.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rnmbake {

struct MergeOptions {
  Normalize normalize = Normalize::none;
  int dilate = 4;       // texels; 0 = off
  bool repair = false;  // replace non-finite texels and fireflies from their neighbours
  Depth depth = Depth::half;
};

/// What the merge saw; goes into the manifest. Texels count once, however many bases they are at fault in.
struct MergeCounts {
  std::size_t covered_texels = 0;
  std::size_t non_finite = 0;   // covered texels with NaN or Inf in any basis, before repair
  std::size_t fireflies = 0;    // covered texels far above their neighbours in any basis (lightmap/faults.h)
  std::size_t repaired = 0;     // texels replaced in any basis; 0 unless asked for
  std::size_t beyond_half = 0;  // values of covered texels clamped to 65504 (depth half only)
  std::size_t negative = 0;     // values of covered texels below 0; kept
  std::size_t black = 0;        // covered texels that are exactly 0 in every basis
  std::size_t unscalable = 0;   // values with nothing to scale, set to flat (normalize flat only)
};

struct MergedLightmap {
  LayeredImage image;  // layers "" (flat), rnm0.., coverage, and tangent / normal where given
  MergeCounts counts;
};

/// Counts, repairs, normalizes, clamps, dilates. Coverage, tangents and normals are never dilated, and
/// uncovered texels that dilation does not reach are 0. Attributes are left to write_metadata(). Throws
/// Error(invalid_input) where the images differ in size, a picture does not have 3 channels or no basis was
/// given, and Error(usage) where Normalize::flat lacks the flat bake or one of rnm0 .. rnm2.
[[nodiscard]] MergedLightmap merge(const TargetBakes& bakes, const MergeOptions& options);

}  // namespace rnmbake
