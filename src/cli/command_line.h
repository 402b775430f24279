// cli/command_line.h - a command as somebody would type it again.
#pragma once

#include "config/resolve.h"

#include <string>

namespace rnmbake {

/// A word as a shell takes it back.
[[nodiscard]] std::string shell_word(const std::string& word);

/// "rnmbake validate hall.blend --samples 64 ...": the scene or project, and each flag and variable that was
/// given.
[[nodiscard]] std::string command_line(const std::string& command, const ResolvedConfig& config);

}  // namespace rnmbake
