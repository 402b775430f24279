// pipeline/validate/validate_plan.h - bakes and traces of a validation, decided before its first step.
#pragma once

#include "pipeline/validate/decompose.h"
#include "pipeline/validate/split_study.h"
#include "pipeline/validate/validate_options.h"
#include "pipeline/validate/variants.h"
#include "trace/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

/// Read by every step, changed by none. `base` and `scene` refer to other members, so it stays where it is.
struct ValidatePlan {
  /// Exports the scene. Throws as validate() says.
  ValidatePlan(BlenderSession& used, const std::vector<BasisDirection>& bases,
               const ValidateOptions& options);
  ValidatePlan(const ValidatePlan&) = delete;
  ValidatePlan& operator=(const ValidatePlan&) = delete;
  ~ValidatePlan() = default;

  [[nodiscard]] bool decomposes() const { return !decomposed.targets.empty(); }

  BlenderSession& session;
  int view;    // pixels along the longer side; 0: none
  int probes;  // light probes around the scene, about; 0: none
  ExportResult exported;
  ReferencePlan truth;  // the reference without a limit of bounces, whatever that of the bakes
  TraceScene scene;
  Store store;
  VariantBase base;
  TargetList decomposed;                  // what the published recipe bakes, too
  bool own_materials;                     // some are not diffuse; the lambert scene has substitutes
  int bounce_limit;                       // of the bakes
  bool bounce_limit_counts;               // so that it is traced, too
  std::vector<std::string> not_followed;  // by the reference
  std::vector<Splitting> study;           // empty: none was asked for
};

[[nodiscard]] BakeVariant bake_variant(BakingSettings::Recipe recipe, SceneSettings::Materials materials);

/// Bakes in their order.
[[nodiscard]] std::vector<BakeVariant> bake_variants(const ValidatePlan& plan);

[[nodiscard]] TraceVariant truth_variant(const ValidatePlan& plan);

/// Truth with the bakes' limit of bounces: the same paths, cut off. The truth itself where the limit does not
/// matter.
[[nodiscard]] TraceVariant limited_variant(const ValidatePlan& plan);

/// The truth with the recipe's faults up to one of them.
struct Emulation {
  const char* fault;
  TraceVariant variant;
};

/// Traces with the first 1, 2, ... faults of this Blender; none where no object is decomposed.
[[nodiscard]] std::vector<Emulation> emulations(const ValidatePlan& plan);

/// Folders of a recipe's two halves, and of what was traced.
[[nodiscard]] Halves halves_of(const ValidatePlan& plan, BakingSettings::Recipe recipe,
                               SceneSettings::Materials materials);
[[nodiscard]] std::filesystem::path folder_of(const ValidatePlan& plan, const TraceVariant& variant);

}  // namespace rnmbake
