// cli/shaders/shaders.h - the command `rnmbake shaders`: the decoders as files that an engine takes.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Adds the subcommand to `app`; the returned function runs it with the options that were parsed.
[[nodiscard]] std::function<int()> add_shaders_command(CLI::App& app);

}  // namespace rnmbake
