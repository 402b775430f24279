// blender/probe.h - version and abilities of an installed Blender.
#pragma once

#include "blender/blender_info.h"

#include <filesystem>
#include <string_view>

namespace rnmbake {

/// Cheap (`blender --version`, a tenth of a second): executable, version and build; the rest stays empty.
/// Error(environment) if that is no Blender, one older than oldest_blender, or it does not answer.
BlenderInfo probe_version(const std::filesystem::path& executable);

/// Fills version, version_text and build from the output of --version, which may hold other lines. False: no
/// Blender printed that.
bool parse_version(std::string_view output, BlenderInfo& info);

}  // namespace rnmbake
