// blender/outcome.h - outcome of an ended launch: a result, or the cause of its failure in one line.
#pragma once

#include "blender/launch.h"
#include "blender/launch_watch.h"
#include "process/run.h"

namespace rnmbake {

/// Most that a launch may print; Blender's own debug output stays far below it.
inline constexpr std::size_t most_output_bytes = std::size_t{1} << 30;

/// Reads result.json and stdout.log of the launch's folder. `watch`: observations of the run.
LaunchOutcome judge(const Launch& launch, const BlenderInfo& info, const LaunchLimits& limits,
                    const std::string& nonce, const ProcessResult& process, const LaunchWatch& watch);

}  // namespace rnmbake
