// pipeline/lightmaps/manifest.h - DIR/manifest.json: targets, their source, settings and outcome;
// DIR/timings.json (docs/manifest.md).
#pragma once

#include "bake/receiver.h"
#include "bake/targets.h"
#include "pipeline/dispatch/bake_timings.h"
#include "pipeline/lightmaps/deliver_lightmap.h"
#include "pipeline/lightmaps/earlier_lightmaps.h"
#include "pipeline/lightmaps/manifest_file.h"
#include "scene/diffuse_scene.h"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// Entries of a bake by Blender alone.
struct BakeRecord {
  const std::vector<HorizonCounts>& horizons;  // [targets]
  const std::vector<double>& heights;          // [targets] of receivers over their faces, texels; 0: none
  std::string dispatch;                        // basis, object, scene
  BakeTimings timings;
};

/// Entries of what was traced, be it a reference or a bake.
struct ReferenceRecord {
  std::string model;                // true, flat-normal-map
  std::vector<std::string> faults;  // of the latter
  double error = 0;                 // asked for, a share; 0: none
  struct Traced {
    std::int64_t paths = 0, rays = 0;
    double error = 0;  // RMS of the texels' standard errors over their mean, worst direction
  };
  std::vector<Traced> traced;                // [targets]
  const std::vector<OutsideModel>& outside;  // what the tracer cannot do of the scene
  double wall_seconds = 0;
  bool is_bake = false;  // by the tracer; the first three do not count
};

struct ManifestInput {
  const BakeSettings& settings;
  const SceneSurvey& survey;
  const TargetList& list;
  const std::vector<BasisDirection>& bases;
  const std::vector<LightmapHeader>& headers;  // [targets]
  const std::vector<Delivery>& deliveries;     // [targets]
  const SavedScene& saved;
  const EarlierLightmaps& earlier;
  std::variant<BakeRecord, ReferenceRecord> record;
};

/// Lists the lightmaps of this run, and those of an earlier one that still fit, in the scene's order.
/// The same whenever the same bake is run again, and another one as soon as a byte of a lightmap is.
[[nodiscard]] nlohmann::json make_manifest(const ManifestInput& input);

/// Writes it to the output folder, and before that DIR/timings.json: what the run cost, which differs from
/// run to run.
void write_manifest(const ManifestInput& input);

}  // namespace rnmbake
