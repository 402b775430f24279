// process/process.h - a program with its limits, and its result.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rnmbake {

struct ProcessOptions {
  std::vector<std::string> argv;  // argv[0] is looked up in PATH if it holds no slash
  /// Applied in order to our own environment; no value: removed.
  std::vector<std::pair<std::string, std::optional<std::string>>> environment;
  bool bare = false;             // the environment begins empty, not as ours
  std::filesystem::path folder;  // to run in; empty: ours
  std::filesystem::path output;  // file for stdout and stderr; empty: captured into ProcessResult::output
  double total_seconds = 0;      // 0: no limit
  double stall_seconds = 0;      // without progress, see process/stall.h; 0: no limit
  std::size_t output_bytes = 0;  // that it may print, seen at every tick; 0: no limit
  std::size_t memory_bytes = 0;  // that the whole tree may have resident, seen at every tick; 0: no limit
  double grace_seconds = 5;      // between SIGTERM and SIGKILL
  double tick_seconds = 0.25;    // between two looks at the process
};

/// Measurements of the running process.
struct ProcessStatus {
  double wall_seconds = 0, cpu_seconds = 0;
  std::size_t resident_bytes = 0, output_bytes = 0;
};

/// Called at every tick and once after the end. True: the process made progress, which neither CPU time nor
/// output alone prove. May throw: the process is ended, then the exception goes on.
using ProcessTick = std::function<bool(const ProcessStatus&)>;

struct ProcessResult {
  enum class EndedBy { itself, total_limit, stall, output_limit, memory_limit, stop_request };
  EndedBy ended_by = EndedBy::itself;
  int exit_code = 0;  // meaningless if `signal` is set
  int signal = 0;     // that ended the process; 0: it returned
  double wall_seconds = 0, cpu_seconds = 0;
  std::size_t peak_bytes = 0;  // of the whole tree, as far as the ticks saw it
  std::string output;          // if captured

  [[nodiscard]] bool succeeded() const {
    return ended_by == EndedBy::itself && signal == 0 && exit_code == 0;
  }
};

}  // namespace rnmbake
