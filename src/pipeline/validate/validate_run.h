// pipeline/validate/validate_run.h - bakes, traces and compares one scene: how wrong the bake is, and why.
#pragma once

#include "blender/blender_session.h"
#include "encoding/basis_set.h"
#include "pipeline/validate/validate_options.h"
#include "report/comparison.h"
#include "scene/scene_digest.h"

#include <optional>
#include <vector>

namespace rnmbake {

/// Two reports on the same truth. The receiver's has the decomposition of the recipe's error and the study.
struct Validation {
  Report receiver;
  std::optional<Report> recipe;        // none where no object is decomposed
  bool complete = true;                // no object failed in any bake
  std::vector<InputFile> inputs = {};  // that the scene read
  SceneDigest digest = {};
};

/// Bakes the scene of the settings by both recipes, twice each with half of the samples, so that the noise is
/// known; traces the truth and the recipe's errors one after the other; compares. Lightmaps and manifests of
/// each step stay in folders of the output folder. Reports lack title and command. Throws as the steps do,
/// and Error(usage) where a pattern of `decompose` fits no object.
[[nodiscard]] Validation validate(BlenderSession& session, const std::vector<BasisDirection>& bases,
                                  const ValidateOptions& options);

}  // namespace rnmbake
