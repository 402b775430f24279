// support/deferred_shadows.h - normal_shadow_deferred, executed over a G-buffer.
#pragma once

#include "base/math.h"
#include "image/float_image.h"
#include "support/gl_compute.h"

namespace rnmbake {

/// What the shader reads. All pictures of one size.
struct DeferredInput {
  FloatImage normals;  // unit, view space (x right, y up)
  FloatImage depths;   // one channel: the walk shrinks with them
  FloatImage tested;   // one channel: what a step's depth test compares; depths, or a stencil
  float range = 0;     // difference of `tested` from which on a step does not count
  Vec2 walk;           // at depth 1, in UVs whose v runs down, for a light in the screen's plane
  int steps = 32;
  float hardness = 11;
};

/// The share of the light that is left at each pixel; one channel. `light`: unit, towards it, view space.
/// Steps beyond the picture meet its border.
[[nodiscard]] FloatImage deferred_shadows(GlCompute& compute, const DeferredInput& input, const Vec3& light);

/// `depths`, but far from everything where `taken` (one channel) is not `number`: steps there never count.
[[nodiscard]] FloatImage stencilled(FloatImage depths, const FloatImage& taken, float number);

}  // namespace rnmbake
