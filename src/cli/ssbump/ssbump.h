// cli/ssbump/ssbump.h - the command `rnmbake ssbump`: a height map becomes a self-shadowed bump map; and its
// tools.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Adds the subcommand and those below it to `app`; the returned function runs the parsed one.
[[nodiscard]] std::function<int()> add_ssbump_command(CLI::App& app);

}  // namespace rnmbake
