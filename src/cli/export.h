// cli/export.h - the command `rnmbake export`: a scene as the reference tracer sees it, in one file.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Adds the subcommand to `app`; the returned function runs it with the options that were parsed.
/// It knows every flag of `bake`, since they decide what is unwrapped.
[[nodiscard]] std::function<int()> add_export_command(CLI::App& app);

}  // namespace rnmbake
