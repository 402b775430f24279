// pipeline/save_scene.h - a copy of the scene that holds the lightmap UVs which this bake made.
#pragma once

#include "bake/targets.h"
#include "pipeline/workspace.h"
#include "scene/survey.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

/// Writes DIR/<scene>.lightmap-uvs.blend if the settings want it (when_unwrapped: only if something was).
/// Returns the file's name in DIR, or "".
[[nodiscard]] std::string save_scene_with_uvs(Workspace& workspace, const Survey& survey,
                                              const std::filesystem::path& blend,
                                              const std::vector<Target>& targets);

}  // namespace rnmbake
