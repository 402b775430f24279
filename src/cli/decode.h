// cli/decode.h - the command `rnmbake decode`: a lightmap and a normal map become the lit picture.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace rnmbake {

/// Adds the subcommand to `app`; the returned function runs it with the options that were parsed.
[[nodiscard]] std::function<int()> add_decode_command(CLI::App& app);

}  // namespace rnmbake
