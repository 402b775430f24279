// pipeline/reference/reference_run.h - one reference, or a bake by the tracer: targets are traced and become
// lightmaps and a manifest.
#pragma once

#include "config/bake_settings.h"
#include "encoding/basis_set.h"
#include "pipeline/lightmaps/deliver_lightmap.h"
#include "pipeline/lightmaps/earlier_lightmaps.h"
#include "pipeline/reference/kept_traces.h"
#include "pipeline/reference/reference_plan.h"
#include "pipeline/scene/make_targets.h"
#include "trace/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace rnmbake {

/// Scene, targets and bases of a reference; shared by several references.
struct ReferenceSubject {
  const TraceScene& scene;
  const TargetList& list;  // of the scene's objects; samples and seed as its settings say
  const std::vector<BasisDirection>& bases;
  EarlierLightmaps earlier = {};  // stays in the manifest
  TraceCache kept = {};           // what was traced before is not traced again
};

struct ReferenceOutcome {
  std::vector<Delivery> deliveries;  // [targets]
  double wall_seconds = 0;
  std::int64_t rays = 0;
};

/// Traces all targets and writes each as soon as it is complete into the settings' output folder, named as a
/// bake would name it; the manifest last. `title` heads the progress, `saved` goes into the manifest. Throws
/// Interrupted, which leaves the complete lightmaps in place, and Error(io) where no file can be written.
[[nodiscard]] ReferenceOutcome run_reference(const ReferenceSubject& subject, const BakeSettings& settings,
                                             const ReferencePlan& plan, const std::string& title = "tracing",
                                             const SavedScene& saved = {});

}  // namespace rnmbake
