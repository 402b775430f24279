// blender/probe.h - which Blender is there and what it can do.
#pragma once

#include "blender/blender_info.h"

#include <filesystem>
#include <string_view>

namespace rnmbake {

class ScriptFolder;

/// Cheap (`blender --version`, a tenth of a second): executable, version and build; the rest stays empty.
/// Error(environment) if that is no Blender, one older than oldest_blender, or it does not answer.
BlenderInfo probe_version(const std::filesystem::path& executable);

/// Fills in devices, numpy and denoiser by one headless launch (1-2 s). Error(environment) if it fails.
void probe_devices(BlenderInfo& info, const ScriptFolder& scripts);

/// From the output of --version, whatever else it holds; fills version, version_text and build.
/// False: no Blender printed that.
bool parse_version(std::string_view output, BlenderInfo& info);

}  // namespace rnmbake
