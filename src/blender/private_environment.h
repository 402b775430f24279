// blender/private_environment.h - keeps what users set up out of launches, and launches out of their folders.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rnmbake {

/// HOME and TMPDIR inside `folder`, and nothing from outside that could change what Blender does. `bytecode`:
/// see ScriptFolder; empty: Python keeps nothing.
std::vector<std::pair<std::string, std::optional<std::string>>> private_environment(
    const std::filesystem::path& folder, const std::filesystem::path& bytecode = {});

}  // namespace rnmbake
