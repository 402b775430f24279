// cli/reference.h - rnmbake reference: a scene goes in, traced lightmaps with standard errors come out.
#pragma once

#include "config/resolve.h"

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Traces the scene of these settings into their output folder. Returns the exit code; throws as its steps.
int trace_reference(const ResolvedConfig& config);

/// Registers `reference` and its flags; the function runs it and returns the exit code.
std::function<int()> add_reference_command(CLI::App& app);

}  // namespace rnmbake
