// pipeline/manifest.h - DIR/manifest.json: what was baked, from what, how it went (docs/manifest.md).
#pragma once

#include "bake/receiver.h"
#include "pipeline/delivery.h"
#include "pipeline/dispatcher.h"
#include "pipeline/make_targets.h"
#include "scene/survey.h"

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// Raised when a reader of the old form would misunderstand the new one.
inline constexpr int manifest_schema_version = 1;

struct ManifestInput {
  const BakeSettings& settings;
  const Survey& survey;
  const TargetList& list;
  const std::vector<BasisDirection>& bases;
  const std::vector<DeliveryNote>& notes;      // [targets]
  const std::vector<HorizonCounts>& horizons;  // [targets]
  const std::vector<Delivery>& deliveries;     // [targets]
  std::string dispatch;                        // basis, object, scene
  std::string scene_with_uvs;                  // file in the output folder, "" if none was saved
  BakeTimings timings;
};

/// Everything except "timings" is the same whenever the same bake is run again.
[[nodiscard]] nlohmann::json make_manifest(const ManifestInput& input);

}  // namespace rnmbake
