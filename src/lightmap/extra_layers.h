// lightmap/extra_layers.h - what a traced lightmap knows beyond a baked one.
#pragma once

#include "image/layered_exr.h"
#include "lightmap/merge.h"

#include <string>
#include <vector>

namespace rnmbake {

/// All pictures have the lightmap's size and are 0 where nothing is covered.
struct ExtraLayers {
  struct StandardError {
    std::string basis;
    FloatImage picture;  // RGB, E/pi
  };
  std::vector<StandardError> standard_errors;
  FloatImage validity;         // one channel, 1 = sound; empty: none
  std::vector<FloatImage> sh;  // RGB; radiance in tangent space, order l, m = 0: (0,0), (1,-1), (1,0), ...

  [[nodiscard]] bool empty() const { return standard_errors.empty() && validity.empty() && sh.empty(); }
};

/// Adds `flat_stderr`, `rnm0_stderr`, ..., `sh0`, ... and `validity` in front of `coverage`. The harmonics
/// are dilated as the maps are, the others are about texels and are not. With Normalize::flat there are no
/// standard errors: those of the scaled maps are not known.
void add_extra_layers(ExtraLayers extra, const MergeOptions& options, LayeredImage& image);

}  // namespace rnmbake
