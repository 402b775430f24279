// blender/private_environment.h - keeps the user's settings out of launches, and launches out of the user's
// folders.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rnmbake {

/// HOME and TMPDIR inside `folder`, without variables that change Blender's behaviour. `bytecode`: see
/// ScriptFolder; empty: Python keeps nothing.
std::vector<std::pair<std::string, std::optional<std::string>>> private_environment(
    const std::filesystem::path& folder, const std::filesystem::path& bytecode = {});

}  // namespace rnmbake
