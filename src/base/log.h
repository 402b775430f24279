// base/log.h - diagnostics on stderr, as text or as one JSON object a line.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace rnmbake::log {

enum class Level { trace, debug, info, warning, error };
enum class Format { text, jsonl };

/// Verbosity: -1 errors only, 0 information, 1 debug, 2 everything. Text is coloured on a terminal unless
/// NO_COLOR is set. May be called again; before the first call: information, text.
void init(int verbosity, Format format);

/// Whether `init` was told to say errors only, or to write JSON.
bool is_quiet();
bool is_jsonl();

/// How text is coloured is decided by `init`; this says whether stderr is a terminal at all.
bool stderr_is_terminal();

void write(Level level, std::string_view message);

/// Draws over the present line of the terminal and leaves it to be overwritten by the next message or bar.
/// An empty text removes the bar.
void draw_bar(std::string_view text);

/// What `write` would print: the formats without the terminal.
std::string format_line(Format format, Level level, std::string_view message, bool colour);

template <typename... Args>
void trace(fmt::format_string<Args...> format, Args&&... args) {
  write(Level::trace, fmt::format(format, std::forward<Args>(args)...));
}
template <typename... Args>
void debug(fmt::format_string<Args...> format, Args&&... args) {
  write(Level::debug, fmt::format(format, std::forward<Args>(args)...));
}
template <typename... Args>
void info(fmt::format_string<Args...> format, Args&&... args) {
  write(Level::info, fmt::format(format, std::forward<Args>(args)...));
}
template <typename... Args>
void warn(fmt::format_string<Args...> format, Args&&... args) {
  write(Level::warning, fmt::format(format, std::forward<Args>(args)...));
}
template <typename... Args>
void error(fmt::format_string<Args...> format, Args&&... args) {
  write(Level::error, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace rnmbake::log
