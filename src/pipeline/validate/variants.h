// pipeline/validate/variants.h - one scene baked and traced in several ways, each into a folder of its own.
#pragma once

#include "jobs/store.h"
#include "pipeline/bake/bake_run.h"
#include "pipeline/reference/reference_run.h"
#include "pipeline/scene/export_scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

/// Input that all variants of one scene share.
struct VariantBase {
  const BlenderSession& session;
  const ExportResult& exported;
  const TraceScene& scene;
  const std::vector<BasisDirection>& bases;
  Store& store;       // what was baked and traced before is not made again, unless ...
  bool anew = false;  // ... all is to be made anew
};

/// Two bakes with half of the samples each and different seeds.
struct BakeVariant {
  BakingSettings::Recipe recipe = BakingSettings::Recipe::receiver;
  SceneSettings::Materials materials = SceneSettings::Materials::lambert;
  std::filesystem::path folder;  // below the output folder; the halves lie in 1/ and 2/
  int seed = 0;                  // added to each target's own; the second half has the next one
  bool timed = false;            // its time counts, so that all of it is baked
};

/// The folder of a half, 0 or 1.
[[nodiscard]] std::filesystem::path half_folder(const VariantBase& base, const BakeVariant& variant,
                                                int half);

/// Bakes one half of a variant.
[[nodiscard]] BakeOutcome bake_half(const VariantBase& base, const TargetList& list,
                                    const BakeVariant& variant, int half);

struct TraceVariant {
  ReferencePlan plan;
  std::filesystem::path folder;  // below the output folder
  int seed = 0;                  // added to each target's own
  std::string title;             // of the progress
};

/// Traces with several times the bake's samples, so that the noise of a comparison is the bake's.
[[nodiscard]] ReferenceOutcome trace_variant(const VariantBase& base, const TargetList& list,
                                             const TraceVariant& variant);

}  // namespace rnmbake
