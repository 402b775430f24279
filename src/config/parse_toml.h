// config/parse_toml.h - TOML that others wrote.
#pragma once

#include "base/error.h"

#include <cstdint>
#include <string>
#include <string_view>

#include <toml++/toml.h>

namespace rnmbake {

/// More than any project or basis file has; the parser takes many times as much memory.
constexpr std::uintmax_t largest_toml = std::uintmax_t{16} << 20;

/// Throws Error(code) with file and line where the text is no TOML, or a key has more parts than any setting
/// ("a.b.c" has three): toml++ takes stack for each.
[[nodiscard]] toml::table parse_toml(std::string_view text, const std::string& file, ExitCode code);

}  // namespace rnmbake
