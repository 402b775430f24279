// base/error.h - the one exception type of the program and its exit codes.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {

/// What the process returns; documented in docs/exit-codes.md. Signals add 128 (130 SIGINT, 143 SIGTERM).
enum class ExitCode {
  ok = 0,
  usage = 1,               // a flag, key or value that does not exist or does not fit
  io = 2,                  // a file cannot be read or written
  invalid_input = 3,       // a file was read but what it holds cannot be baked
  environment = 4,         // no Blender, one too old, a part of it missing
  unsupported = 5,         // understood, but not something that this build can do
  tasks_failed = 6,        // some objects failed; the rest was delivered
  threshold_exceeded = 7,  // a comparison went past --fail-above
  lock_held = 8,           // another rnmbake writes to the same folder
};

/// A failure that the user can act upon. The message names the file or object, says what is wrong and
/// what would mend it, in one line. Thrown anywhere, caught once in main.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

template <typename... Args>
[[noreturn]] void fail(ExitCode code, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(code, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace rnmbake
