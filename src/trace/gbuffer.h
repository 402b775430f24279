// trace/gbuffer.h - what a deferred renderer keeps of a camera's view: the surface at each pixel's centre.
#pragma once

#include "image/float_image.h"
#include "trace/view.h"

#include <functional>

namespace rnmbake {

/// One primary ray through each pixel's centre, nothing averaged: a mean of two surfaces is neither. World
/// space, units of the scene. All 0 where no surface is met.
struct GBuffer {
  FloatImage normal;    // three channels: what the caller gives
  FloatImage face;      // three: geometric normal, unit, on the side that is seen
  FloatImage position;  // three
  FloatImage depth;     // one: distance from the camera along its axis
  FloatImage object;    // one: index into SceneSurvey::objects, plus 1
  FloatImage coverage;  // one: 1 where there is a surface
};

/// Vector that the G-buffer keeps of a surface.
using SurfaceVector = std::function<Vec3(const Vertex& vertex)>;

/// `normal` is called from several threads. Takes size, seed (for what is see-through) and threads of the
/// options; `progress` and `stop` as trace_view().
[[nodiscard]] GBuffer trace_gbuffer(const TraceScene& scene, const Camera& camera, const ViewOptions& options,
                                    const SurfaceVector& normal,
                                    const std::function<void(double)>& progress = {},
                                    const std::function<bool()>& stop = {});

}  // namespace rnmbake
