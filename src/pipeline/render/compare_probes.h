// pipeline/render/compare_probes.h - what light probes make of moving objects, held against the traced truth.
#pragma once

#include "pipeline/render/render_view.h"
#include "report/comparison.h"
#include "trace/scene.h"

namespace rnmbake {

/// The truth, then each encoding of the probes with the best test against leaks that they allow, then the
/// harmonics of order 3 with the others. Errors are over the pixels that show what the probes light, edges
/// left out. Throws as render_view(), and Error(invalid_input) where the view shows nothing of that.
[[nodiscard]] ViewComparison compare_probes_view(const TraceScene& scene, const SurfaceLights& lights,
                                                 const RenderOptions& options);

}  // namespace rnmbake
