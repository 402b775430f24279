// pipeline/reference/reference_plan.h - model, Blender version and error of a reference, out of the settings.
#pragma once

#include "blender/probe.h"
#include "config/resolve.h"
#include "trace/gather.h"

#include <span>
#include <string>
#include <vector>

namespace rnmbake {

/// Settings that all targets of a reference share. Samples and seed are each target's own.
struct ReferencePlan {
  bool is_bake = false;         // headers, layers and manifest are those of a bake
  std::string blender_version;  // whose light units, footprint, edges and faults
  Footprint footprint = Footprint::half;
  PastEdge past_edge = PastEdge::retry;
  bool flat_normal_map = false;  // the model
  RecipeFaults faults;           // of that model
  double error = 0;              // share of the mean; 0: off. Of a bake it is each target's own
  int most_samples = 0;          // with `error`; 0: each target's own
  int bounces = -1;              // -1: no limit
  int sh = 0;
  int threads = 0;
};

/// `scene_version`: of the Blender that wrote the scene's data. Throws Error(usage) where the settings name a
/// fault or version that does not exist.
[[nodiscard]] ReferencePlan plan_reference(const ResolvedConfig& config, const std::string& scene_version);

/// Of a bake by the tracer ([bake] engine = "embree"), which goes by the settings of bakes alone. Throws
/// Error(usage) where these ask for something that only Cycles does.
[[nodiscard]] ReferencePlan plan_traced_bake(const ResolvedConfig& config, const std::string& scene_version);

/// "3.4.1", "4.3", "5.2.2 LTS". Throws Error(usage), naming `where`.
[[nodiscard]] BlenderVersion blender_version_of(const std::string& text, const std::string& where);

/// Footprint and edges of that Blender's bakes, into the plan.
void follow(const BlenderVersion& version, ReferenceSettings::Footprint footprint, ReferencePlan& plan);

/// The errors that the published recipe has in that Blender.
[[nodiscard]] RecipeFaults faults_of(const BlenderVersion& version);

struct NamedFault {
  const char* flag;   // "tilt-clamp"
  const char* words;  // "tilt clamp"
  bool RecipeFaults::*on;
};
/// Every fault, in the order in which validate adds one to those before it.
[[nodiscard]] std::span<const NamedFault> all_faults();

/// Names of the faults that are on: "tilt-clamp", "bump-shadowing", ...
[[nodiscard]] std::vector<std::string> names_of(const RecipeFaults& faults);

[[nodiscard]] const char* name_of(Footprint footprint);  // as headers say it: "half texel"

}  // namespace rnmbake
