// jobs/depfile.h - what an output was made from, as make and Ninja read it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rnmbake {

/// One rule, "target: input input ...", an input a line; each input once, in the order given. Spaces, #, $,
/// colons and backslashes before them are escaped as GNU make and Ninja take them back. A name with a line
/// break cannot be said in make's syntax and is left out.
[[nodiscard]] std::string depfile_text(const std::filesystem::path& target,
                                       const std::vector<std::filesystem::path>& inputs);

/// Writes it; its folder is made. Throws Error(io).
void write_depfile(const std::filesystem::path& file, const std::filesystem::path& target,
                   const std::vector<std::filesystem::path>& inputs);

}  // namespace rnmbake
