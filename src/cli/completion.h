// cli/completion.h - `rnmbake completion` and `rnmbake man`: what the parser knows, for shells and for man.
#pragma once

#include <functional>

namespace CLI {
class App;
}  // namespace CLI

namespace rnmbake {

/// Both print the text for the whole of `app`, which holds every command when they run.
[[nodiscard]] std::function<int()> add_completion_command(CLI::App& app);
[[nodiscard]] std::function<int()> add_man_command(CLI::App& app);

}  // namespace rnmbake
