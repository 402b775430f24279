// bake/assemble.h - the atlas rectangles that were baked for a target become its per-basis pictures.
#pragma once

#include "bake/plan.h"
#include "image/bakes.h"
#include "scene/surface.h"

#include <vector>

namespace rnmbake {

/// `pictures`: baked picture of each of `rects` (all of one target), RGBA with alpha = coverage. `surface`
/// gives the geometry for the horizon identity (bake/receiver.h) and for the frames; it may be null where
/// neither is needed. Throws Error(tasks_failed) if no texel at all was baked although the target covers
/// some.
[[nodiscard]] TargetBakes assemble(const Target& target, const std::vector<const AtlasRect*>& rects,
                                   const std::vector<FloatImage>& pictures,
                                   const std::vector<BasisDirection>& bases, const Surface* surface,
                                   bool frames);

/// Fills `tangent` and `normal` of bakes whose coverage has its size.
void fill_frames(const Surface& surface, TargetBakes& bakes);

/// Whether a target has rectangles of the horizon identity.
[[nodiscard]] bool needs_surface(const std::vector<const AtlasRect*>& rects);

}  // namespace rnmbake
