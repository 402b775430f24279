// blender/probe.h - version and abilities of an installed Blender.
#pragma once

#include "blender/blender_info.h"

#include <filesystem>
#include <string_view>

namespace rnmbake {

/// Cheap (`blender --version`, a tenth of a second; of Python's module bpy a second): executable, version and
/// build, of the module its folders; the rest stays empty. Error(environment) if that is no Blender, one
/// older than oldest_blender, or it does not answer.
BlenderInfo probe_version(const std::filesystem::path& executable, double limit_seconds = 60);

/// Fills version, version_text and build from the output of --version, which may hold other lines. False: no
/// Blender printed that.
bool parse_version(std::string_view output, BlenderInfo& info);

}  // namespace rnmbake
