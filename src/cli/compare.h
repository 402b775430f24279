// cli/compare.h - the command `rnmbake compare`: errors between two sets of lightmaps.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Adds the subcommand to `app`; the returned function runs it with the options that were parsed.
[[nodiscard]] std::function<int()> add_compare_command(CLI::App& app);

}  // namespace rnmbake
