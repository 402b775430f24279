// blender/outcome.h - what an ended launch means: a result, or one line about why there is none.
#pragma once

#include "blender/launch.h"
#include "process/run.h"

namespace rnmbake {

/// Reads result.json and stdout.log of the launch's folder.
LaunchOutcome judge(const Launch& launch, const LaunchLimits& limits, const std::string& nonce,
                    const ProcessResult& process);

}  // namespace rnmbake
