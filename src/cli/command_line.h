// cli/command_line.h - a command line that repeats a run.
#pragma once

#include "config/resolve.h"

#include <string>

namespace rnmbake {

/// Quotes a word for a shell.
[[nodiscard]] std::string shell_word(const std::string& word);

/// "rnmbake validate hall.blend --samples 64 ...": the scene or project, and each flag and variable that was
/// given.
[[nodiscard]] std::string command_line(const std::string& command, const ResolvedConfig& config);

}  // namespace rnmbake
