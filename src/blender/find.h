// blender/find.h - path of the Blender to use.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace rnmbake {

/// The first of: `wanted` (--blender; a path, or a name to look for in PATH), RNMBAKE_BLENDER, "blender" in
/// PATH, the usual places. Throws Error(environment) with the remedy, also where `wanted` or the variable
/// names no Blender: the search does not go on then.
std::filesystem::path find_blender(const std::optional<std::string>& wanted = {});

}  // namespace rnmbake
