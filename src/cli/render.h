// cli/render.h - the command `rnmbake render`: a camera's view of a scene, lit by its lightmaps or traced.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Adds the subcommand to `app`; the returned function runs it with the options that were parsed.
[[nodiscard]] std::function<int()> add_render_command(CLI::App& app);

}  // namespace rnmbake
