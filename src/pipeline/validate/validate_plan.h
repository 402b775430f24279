// pipeline/validate/validate_plan.h - what a validation bakes and traces, decided before its first step.
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
  int view;  // pixels along the longer side; 0: none
  ExportResult exported;
  ReferencePlan truth;  // the reference without a limit of bounces, whatever that of the bakes
  TraceScene scene;
  VariantBase base;
  TargetList decomposed;                  // what the published recipe bakes, too
  bool own_materials;                     // some that the lambert scene only stands in for
  int bounce_limit;                       // of the bakes
  bool bounce_limit_counts;               // so that it is traced, too
  std::vector<std::string> not_followed;  // by the reference
  std::vector<Splitting> study;           // empty: none was asked for
};

[[nodiscard]] BakeVariant bake_variant(BakingSettings::Recipe recipe, SceneSettings::Materials materials);

/// In the order in which they are baked.
[[nodiscard]] std::vector<BakeVariant> bake_variants(const ValidatePlan& plan);

[[nodiscard]] TraceVariant truth_variant(const ValidatePlan& plan);

/// The truth as far as the bakes follow it: the same paths, but shorter. The truth itself where that is all.
[[nodiscard]] TraceVariant limited_variant(const ValidatePlan& plan);

/// The truth with the recipe's faults up to one of them.
struct Emulation {
  const char* fault;
  TraceVariant variant;
};

/// The faults that this Blender has, one more each time; none where nothing is decomposed.
[[nodiscard]] std::vector<Emulation> emulations(const ValidatePlan& plan);

/// Folders of a recipe's two halves, and of what was traced.
[[nodiscard]] Halves halves_of(const ValidatePlan& plan, BakingSettings::Recipe recipe,
                               SceneSettings::Materials materials);
[[nodiscard]] std::filesystem::path folder_of(const ValidatePlan& plan, const TraceVariant& variant);

}  // namespace rnmbake
