// cli/deliver.h - rnmbake deliver: a scene goes in, what an engine opens comes out.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Registers `deliver` and its flags; the function runs it and returns the exit code.
std::function<int()> add_deliver_command(CLI::App& app);

}  // namespace rnmbake
