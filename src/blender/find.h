// blender/find.h - where the Blender to use is.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace rnmbake {

/// The first of: `wanted` (--blender; a path, or a name to look for in PATH), RNMBAKE_BLENDER, "blender" in
/// PATH, the usual places. What is named explicitly must be right: it is never passed over in silence.
/// Error(environment) with the remedy.
std::filesystem::path find_blender(const std::optional<std::string>& wanted = {});

}  // namespace rnmbake
