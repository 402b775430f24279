// blender/outcome.h - what an ended launch means: a result, or one line about why there is none.
#pragma once

#include "blender/launch.h"
#include "blender/launch_watch.h"
#include "process/run.h"

namespace rnmbake {

/// Most that a launch may print; Blender's own debug output stays far below it.
inline constexpr std::size_t most_output_bytes = std::size_t{1} << 30;

/// Reads result.json and stdout.log of the launch's folder. `watch`: what was seen while it ran.
LaunchOutcome judge(const Launch& launch, const BlenderInfo& info, const LaunchLimits& limits,
                    const std::string& nonce, const ProcessResult& process, const LaunchWatch& watch);

}  // namespace rnmbake
