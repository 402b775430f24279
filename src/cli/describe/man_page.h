// cli/describe/man_page.h - the manual page of a command, in roff.
#pragma once

#include "cli/describe/command_tree.h"

#include <string>

namespace rnmbake {

/// rnmbake(1), rnmbake-bake(1), rnmbake-ssbump-info(1), ...: the text of --help under man's headings.
[[nodiscard]] std::string man_page(const CommandEntry& program, const CommandEntry& command);

/// "rnmbake-ssbump-info".
[[nodiscard]] std::string page_name(const CommandEntry& command);

}  // namespace rnmbake
