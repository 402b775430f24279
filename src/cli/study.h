// cli/study.h - the command `rnmbake study`: what each encoding loses of a light.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Adds the subcommand to `app`; the returned function runs it with the options that were parsed.
[[nodiscard]] std::function<int()> add_study_command(CLI::App& app);

}  // namespace rnmbake
