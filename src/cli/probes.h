// cli/probes.h - `rnmbake probes`.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

std::function<int()> add_probes_command(CLI::App& app);

}  // namespace rnmbake
