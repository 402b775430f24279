// bake/uv_problems.h - faults of UVs: counts, words, remedies.
#pragma once

#include "scene/uv_report.h"

#include <cstddef>
#include <string>
#include <vector>

namespace rnmbake {

struct UvProblem {
  enum class Kind { overlap, tiles, outside, no_uv_area, no_area, doubled, capped, mirrored };
  Kind kind = Kind::overlap;
  std::size_t count = 0;  // texels, triangles or charts; of `capped`: the side that texels_per_unit asked for
};

/// Doubled triangles are a problem where they are more than one in fifty. `wanted_side` is what
/// texels_per_unit asks for, `side` what the lightmap has.
[[nodiscard]] std::vector<UvProblem> uv_problems(const UvReport& report, int side, int wanted_side);

/// "12 texels overlap".
[[nodiscard]] std::string spoken(const UvProblem& problem);

/// Harm and remedy; "" for problems that do no harm.
[[nodiscard]] const char* remedy(UvProblem::Kind kind);

}  // namespace rnmbake
