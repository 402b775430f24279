// cli/inspect.h - the command `rnmbake inspect`: objects of a scene, with the targets and faults of a bake.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Adds the subcommand to `app`; the returned function runs it with the options that were parsed.
/// It knows every flag of `bake`, since they decide what would be baked.
[[nodiscard]] std::function<int()> add_inspect_command(CLI::App& app);

}  // namespace rnmbake
