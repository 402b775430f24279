// cli/farm/farm.h - a bake on many machines: `rnmbake submit`, `task`, `status`.
#pragma once

#include <functional>

namespace CLI {
class App;
}  // namespace CLI

namespace rnmbake {

/// Each adds its command; what is returned runs it and gives the exit code.
[[nodiscard]] std::function<int()> add_submit_command(CLI::App& app);
[[nodiscard]] std::function<int()> add_task_command(CLI::App& app);
[[nodiscard]] std::function<int()> add_status_command(CLI::App& app);

}  // namespace rnmbake
