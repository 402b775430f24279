// cli/ssbump/ssbump_tools.h - the commands below `rnmbake ssbump`: one file each.
#pragma once

#include "ssbump/map/encode.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace rnmbake {

/// Each adds its subcommand to `ssbump`; the function that it returns runs it.
[[nodiscard]] std::vector<std::function<std::function<int()>(CLI::App& ssbump)>> ssbump_tools();

[[nodiscard]] std::function<int()> add_ssbump_info(CLI::App& ssbump);
[[nodiscard]] std::function<int()> add_ssbump_to_normal(CLI::App& ssbump);
[[nodiscard]] std::function<int()> add_ssbump_from_normal(CLI::App& ssbump);
[[nodiscard]] std::function<int()> add_ssbump_combine(CLI::App& ssbump);
[[nodiscard]] std::function<int()> add_ssbump_flip(CLI::App& ssbump);
[[nodiscard]] std::function<int()> add_ssbump_mip(CLI::App& ssbump);
[[nodiscard]] std::function<int()> add_ssbump_compress_check(CLI::App& ssbump);

}  // namespace rnmbake
