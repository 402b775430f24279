// cli/describe/completion.h - scripts by which shells complete command lines of rnmbake.
#pragma once

#include "cli/describe/command_tree.h"

#include <string>

namespace rnmbake {

/// For /usr/share/bash-completion/completions/rnmbake; needs bash 4, not the package bash-completion.
[[nodiscard]] std::string bash_completion(const CommandEntry& program);

/// For _rnmbake in a folder of $fpath.
[[nodiscard]] std::string zsh_completion(const CommandEntry& program);

/// For rnmbake.fish in fish's vendor_completions.d.
[[nodiscard]] std::string fish_completion(const CommandEntry& program);

/// A word in quotes that bash and zsh read alike.
[[nodiscard]] std::string single_quoted(const std::string& text);

}  // namespace rnmbake
