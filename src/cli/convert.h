// cli/convert.h - the command `rnmbake convert`: lightmaps in another encoding.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Adds the subcommand to `app`; the returned function runs it with the options that were parsed.
[[nodiscard]] std::function<int()> add_convert_command(CLI::App& app);

}  // namespace rnmbake
