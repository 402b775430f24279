// cli/bake.h - rnmbake bake: a scene goes in, lightmaps and a manifest come out.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Registers `bake` and its flags; the function runs it and returns the exit code.
std::function<int()> add_bake_command(CLI::App& app);

}  // namespace rnmbake
