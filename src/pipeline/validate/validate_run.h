// pipeline/validate/validate_run.h - bakes, traces and compares one scene: how wrong the bake is, and why.
#pragma once

#include "blender/blender_session.h"
#include "encoding/basis_set.h"
#include "report/comparison.h"

#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

struct ValidateOptions {
  std::vector<std::string> decompose{"*"};  // objects (glob patterns) that the published recipe bakes too
  bool split_study = false;
  int view = 480;  // pixels along the longer side of the camera's view in the report; 0: none
};

/// Two reports on the same truth. The receiver's has the decomposition of the recipe's error and the study.
struct Validation {
  Report receiver;
  std::optional<Report> recipe;  // none where no object is decomposed
  bool complete = true;          // no object failed in any bake
};

/// Bakes the scene of the settings by both recipes, twice each with half of the samples, so that the noise is
/// known; traces the truth and the recipe's errors one after the other; compares. Lightmaps and manifests of
/// each step stay in folders of the output folder. Reports lack title and command. Throws as the steps do,
/// and Error(usage) where a pattern of `decompose` fits no object.
[[nodiscard]] Validation validate(Workspace& workspace, const std::vector<BasisDirection>& bases,
                                  const ValidateOptions& options);

}  // namespace rnmbake
