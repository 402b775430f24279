// cli/flags/command_line.h - a command line that repeats a run.
#pragma once

#include "config/resolve.h"

#include <string>
#include <vector>

namespace rnmbake {

/// Quotes a word for a shell.
[[nodiscard]] std::string shell_word(const std::string& word);

/// The flag that gives a setting its value, and the value as its next word where it takes one.
[[nodiscard]] std::vector<std::string> flag_words(const SettingOverride& given);

/// The project file that settings came from; "": none.
[[nodiscard]] std::string project_of(const ResolvedConfig& config);

/// "rnmbake validate hall.blend --samples 64 ...": the scene or project, and each flag and variable that was
/// given.
[[nodiscard]] std::string command_line(const std::string& command, const ResolvedConfig& config);

}  // namespace rnmbake
