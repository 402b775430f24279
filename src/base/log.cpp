#include "base/log.h"

#include "base/events/log_event.h"
#include "base/text.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <mutex>

#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

namespace rnmbake::log {

namespace {

constexpr const char* clear_line = "\r\033[K";

struct LevelLook {
  spdlog::level::level_enum level;
  const char* name;    // in JSON
  const char* prefix;  // in text
  const char* colour;
};

const LevelLook& look(Level level) {
  static const LevelLook looks[] = {
      {spdlog::level::trace, "trace", "trace: ", "\033[2m"},
      {spdlog::level::debug, "debug", "debug: ", "\033[2m"},
      {spdlog::level::info, "info", "", ""},
      {spdlog::level::warn, "warning", "warning: ", "\033[33m"},
      {spdlog::level::err, "error", "error: ", "\033[31m"},
  };
  return looks[static_cast<std::size_t>(level)];
}

/// Finished lines come in, and keep clear of the progress bar that may stand on the last line.
class StderrSink : public spdlog::sinks::base_sink<std::mutex> {
 public:
  void draw_bar(std::string_view text) {
    const std::lock_guard lock(mutex_);
    if (text.empty() && !bar_drawn_) return;
    put(fmt::format("{}{}", clear_line, text));
    bar_drawn_ = !text.empty();
  }

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    put(fmt::format("{}{}\n", bar_drawn_ ? clear_line : "",
                    std::string_view(message.payload.data(), message.payload.size())));
    bar_drawn_ = false;
  }
  void flush_() override { std::fflush(stderr); }

 private:
  static void put(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
  }
  bool bar_drawn_ = false;
};

struct State {
  std::shared_ptr<StderrSink> sink = std::make_shared<StderrSink>();
  spdlog::logger logger{"rnmbake", sink};
  std::atomic<Format> format = Format::text;
  std::atomic<bool> colour = false;
};

State& state() {
  static State the_state;
  return the_state;
}

std::string json_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return valid_utf8(out);
}

std::string json_of(const FieldValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return fmt::format("\"{}\"", json_escaped(*text));
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  const double number = std::get<double>(value);
  return std::isfinite(number) ? fmt::format("{}", number) : "null";
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

}  // namespace

void init(int verbosity, Format format) {
  static constexpr spdlog::level::level_enum levels[] = {spdlog::level::err, spdlog::level::info,
                                                         spdlog::level::debug, spdlog::level::trace};
  const int index = std::min(std::max(verbosity, -1), 2) + 1;
  state().logger.set_level(levels[index]);
  state().format = format;
  const char* no_color = std::getenv("NO_COLOR");  // https://no-color.org: any value but the empty one
  state().colour = stderr_is_terminal() && (no_color == nullptr || *no_color == '\0');
}

bool is_quiet() {
  return state().logger.level() >= spdlog::level::err;
}

bool is_jsonl() {
  return state().format == Format::jsonl;
}

bool stderr_is_terminal() {
  return isatty(STDERR_FILENO) == 1;
}

std::string format_event(Format format, Level level, std::string_view kind, std::string_view message,
                         Fields fields, bool colour) {
  const LevelLook& its = look(level);
  if (format == Format::jsonl) {
    std::string line = fmt::format(R"({{"time":"{}","level":"{}","event":"{}","message":"{}")", utc_now(),
                                   its.name, kind, json_escaped(message));
    for (const auto& [name, value] : fields) line += fmt::format(R"(,"{}":{})", name, json_of(value));
    return line + "}";
  }
  const bool painted = colour && *its.colour != '\0';
  return fmt::format("{}rnmbake: {}{}{}", painted ? its.colour : "", its.prefix, painted ? "\033[0m" : "",
                     printable(message, level <= Level::debug));  // tracebacks have lines
}

std::string format_line(Format format, Level level, std::string_view message, bool colour) {
  return format_event(format, level, "message", message, {}, colour);
}

void event(Level level, std::string_view kind, std::string_view message, Fields fields) {
  State& s = state();
  if (!s.logger.should_log(look(level).level)) return;
  const std::string line = format_event(s.format, level, kind, message, fields, s.colour);
  s.logger.log(look(level).level, spdlog::string_view_t(line));
}

void write(Level level, std::string_view message) {
  event(level, "message", message, {});
}

void draw_bar(std::string_view text) {
  state().sink->draw_bar(printable(text));
}

}  // namespace rnmbake::log
