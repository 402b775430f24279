// base/text.h - text for people: counts with their nouns, control characters made visible, case
// left out of account.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace rnmbake {

/// "1 mesh", "2 meshes", "0 entries", out of the noun's singular.
std::string counted(std::size_t count, std::string_view noun);

/// What a terminal may be shown: control characters (escape sequences, C1, line separators, changes of
/// direction) and bytes that are no UTF-8 come out as "\x1b", others as they are. Line breaks only where
/// `keep_lines`.
std::string printable(std::string_view text, bool keep_lines = false);

/// The text with U+FFFD for every byte that is no UTF-8.
std::string valid_utf8(std::string_view text);

/// At most `bytes` bytes of it, with "..." where something was left out.
std::string shortened(std::string_view text, std::size_t bytes);

/// A to Z become a to z; every other byte stays.
std::string lower_case(std::string text);

/// ".exr" of "Map.EXR"; "" where there is none.
std::string lower_extension(const std::filesystem::path& file);

}  // namespace rnmbake
