// base/process_stat.h - one process as /proc/PID/stat shows it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

#include <sys/types.h>

namespace rnmbake {

struct ProcessStat {
  char state = '?';  // R: runs, or waits for nothing but a core; Z: dead and not waited for
  pid_t parent = 0, group = 0, session = 0;
  double cpu_seconds = 0;         // user + system, with children that were already waited for
  std::uint64_t start_ticks = 0;  // since the machine started; tells two processes of one number apart
  std::size_t resident_bytes = 0;
};

/// Of /proc/PID or /proc/PID/task/TID; nothing where there is no such process, or no /proc.
[[nodiscard]] std::optional<ProcessStat> read_process_stat(const std::filesystem::path& folder);

}  // namespace rnmbake
