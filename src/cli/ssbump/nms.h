// cli/ssbump/nms.h - the command `rnmbake nms`: normal mapping shadows, and whether a normal map is good for
// them.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Adds the subcommand to `app`; the returned function runs it with the options that were parsed.
[[nodiscard]] std::function<int()> add_nms_command(CLI::App& app);

}  // namespace rnmbake
