// pipeline/validate/split_study.h - error and time of the published recipe, baked in smaller pieces.
#pragma once

#include "pipeline/validate/variants.h"
#include "report/comparison.h"

#include <string>
#include <vector>

namespace rnmbake {

/// One way to cut objects into targets.
struct Splitting {
  std::string name;  // "whole", "material", "loose", "grid 2", ...
  TargetList list;
};

/// Objects as they are, by material, by loose part, and by the cells of a grid over the scene: by growing
/// number of targets, each number once, without those that are too many to bake one by one. All pieces of an
/// object keep its lightmap's size and UVs, so that the texels compared are the same.
[[nodiscard]] std::vector<Splitting> splittings(const ExportResult& exported);

/// Bakes the targets of one splitting by flat-normal-map and traces their truth, below the output folder. The
/// error is over all bases. `seed`: added to each target's own.
[[nodiscard]] StudyPoint study_point(const VariantBase& base, const Splitting& splitting,
                                     const ReferencePlan& plan, int seed);

}  // namespace rnmbake
