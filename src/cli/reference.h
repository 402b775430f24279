// cli/reference.h - rnmbake reference: a scene goes in, traced lightmaps with standard errors come out.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Registers `reference` and its flags; the function runs it and returns the exit code.
std::function<int()> add_reference_command(CLI::App& app);

}  // namespace rnmbake
