// process/run.h - runs a program in a process group of its own, with limits, and leaves none of it behind.
#pragma once

#include "process/process.h"

#include <string>

namespace rnmbake {

/// Runs to the end. stdin is empty. When this returns, whether after the program's end, a limit or a stop
/// (process/stop.h), the whole tree is gone, with processes that left the group and the session, or whose
/// parents ended before them; should the calling thread die, the kernel ends the child. Throws
/// Error(environment) if the program cannot be started, Error(io) if the output file cannot be made.
ProcessResult run_process(const ProcessOptions& options, const ProcessTick& tick = {});

/// "SIGSEGV", ...; "signal N" for those without a name.
std::string signal_name(int signal);

}  // namespace rnmbake
