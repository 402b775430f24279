// pipeline/unwrap.h - lightmap UVs for meshes that have none, by Blender.
#pragma once

#include "bake/targets.h"
#include "pipeline/workspace.h"
#include "scene/survey.h"

#include <string>
#include <vector>

namespace rnmbake {

struct UnwrapRequest {
  std::size_t object = 0;  // index into Survey::objects
  double margin = 0;       // between charts, as a share of the square's side
};

/// One launch unwraps them all; UVs in the order of the requests, one for each loop. Objects that share a
/// mesh, a scale and a margin share their UVs, so that instances stay instances.
[[nodiscard]] std::vector<Uvs> unwrap(Workspace& workspace, const Survey& survey,
                                      const std::vector<UnwrapRequest>& requests);

}  // namespace rnmbake
