// cli/compare.h - the command `rnmbake compare`: how far two sets of lightmaps are from each other.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Adds the subcommand to `app`; the returned function runs it with the options that were parsed.
[[nodiscard]] std::function<int()> add_compare_command(CLI::App& app);

}  // namespace rnmbake
