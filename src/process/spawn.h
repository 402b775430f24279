// process/spawn.h - fork and exec, with every failure of the child reported to the parent.
#pragma once

#include "process/process.h"

#include <sys/types.h>

namespace rnmbake {

/// Starts options.argv as the leader of a new process group, stdout and stderr to `output_descriptor`.
/// Throws Error(environment) if it cannot be started.
pid_t spawn(const ProcessOptions& options, int output_descriptor);

}  // namespace rnmbake
