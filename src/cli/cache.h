// cli/cache.h - the command `rnmbake cache`: what is kept of earlier runs, kept small and whole.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Adds the subcommand to `app`; the returned function runs it with the options that were parsed.
[[nodiscard]] std::function<int()> add_cache_command(CLI::App& app);

}  // namespace rnmbake
