// cli/bake.h - rnmbake bake: a scene goes in, lightmaps and a manifest come out.
#pragma once

#include "config/resolve.h"

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

struct RunReport;

/// Bakes the scene of these settings into their output folder, or finds that nothing is to be done. `made`:
/// what became of it. Returns the exit code; throws as its steps.
int bake_scene(ResolvedConfig config, RunReport& made);

/// Registers `bake` and its flags; the function runs it and returns the exit code.
std::function<int()> add_bake_command(CLI::App& app);

}  // namespace rnmbake
