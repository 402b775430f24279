// base/events/log_event.h - messages that say in fields, too, what they say in words (docs/logs.md).
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace rnmbake::log {

enum class Level;   // base/log.h
enum class Format;  // base/log.h

using FieldValue = std::variant<std::int64_t, double, std::string>;
using Fields = std::initializer_list<std::pair<std::string_view, FieldValue>>;

/// Writes `message` as log::write does; as JSON it is an event of that kind with these fields. A number that
/// is not finite is null there.
void event(Level level, std::string_view kind, std::string_view message, Fields fields);

/// Without the terminal.
std::string format_event(Format format, Level level, std::string_view kind, std::string_view message,
                         Fields fields, bool colour);

}  // namespace rnmbake::log
