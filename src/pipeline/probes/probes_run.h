// pipeline/probes/probes_run.h - light probes of a scene: placed, settled, lit, filled.
#pragma once

#include "blender/blender_session.h"
#include "pipeline/probes/check_probes.h"
#include "pipeline/probes/place_volumes.h"
#include "pipeline/probes/refine_probes.h"
#include "pipeline/probes/settle_probes.h"
#include "pipeline/reference/reference_plan.h"
#include "pipeline/scene/export_scene.h"
#include "probes/probe_lights.h"
#include "probes/probe_volume.h"

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

enum class ProbeSource { reference, blender };

struct ProbesOptions {
  PlaceWishes places;
  std::vector<std::string> dynamic;  // patterns of objects that move: no part of the light
  ProbeLights lights = ProbeLights::all;
  ProbeSource source = ProbeSource::reference;
  bool lambert = false;  // Blender shows the materials that the reference traces, not the scene's own
  SettleOptions settle;
  RefineOptions refine;
  bool regular = false;     // make regular boxes out of trees as well
  std::size_t check = 200;  // places between the probes at which the truth is traced; 0: none
};

struct ProbesResult {
  std::vector<ProbeVolume> volumes;
  std::vector<ProbeVolume> regular;  // where they were asked for: the same with trees on grids as fine
  nlohmann::json about;              // how they were found, for probes.json
  ProbeCheck check;
};

/// Takes moving objects out of a scene that is to be traced. Throws as dynamic_objects().
void take_out(const std::vector<std::string>& dynamic, DiffuseScene& scene);

/// `scene`: of `exported`, without what moves. Throws as place_volumes(), Error(invalid_input) where every
/// probe stands inside of something, and Interrupted.
[[nodiscard]] ProbesResult run_probes(BlenderSession& session, const ExportResult& exported,
                                      const TraceScene& scene, const ReferencePlan& plan,
                                      const ProbesOptions& options);

}  // namespace rnmbake
