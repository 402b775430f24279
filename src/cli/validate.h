// cli/validate.h - rnmbake validate: how wrong the bake of a scene is, and why, as a report.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Registers `validate` and its flags; the function runs it and returns the exit code.
std::function<int()> add_validate_command(CLI::App& app);

}  // namespace rnmbake
