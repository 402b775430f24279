// pipeline/compare/compare.h - two sets of lightmaps held against each other, object by object.
#pragma once

#include "report/comparison.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

/// A folder that `bake` or `reference` wrote, or one lightmap; the same for both sides.
struct CompareSide {
  std::filesystem::path path;
  std::filesystem::path second;  // the same baked with another seed; empty: none
  std::string label;             // empty: the name of `path`
};

struct CompareOptions {
  CompareSide candidate, reference;
  std::vector<std::string> objects{"*"};  // globs; an object that fits one is compared
  float min_validity = 0;                 // texels of the reference that are less sound do not count
  bool with_maps = true;                  // pictures for the report
};

/// Objects are matched by key (two single files: with each other), texels that are covered on both sides and
/// sound are compared, for each basis that both sides have. Noise comes from the second bakes, else from
/// `*_stderr` layers, else it is not known. Fills everything of the report but title, command,
/// decompositions, study, views and thresholds. Throws Error(io) where files are missing,
/// Error(invalid_input) naming the object where two lightmaps do not fit each other, or where no object is on
/// both sides.
[[nodiscard]] Report compare_lightmaps(const CompareOptions& options);

}  // namespace rnmbake
