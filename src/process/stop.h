// process/stop.h - the user's wish to stop: the first signal is polite, the second one kills.
#pragma once

#include <sys/types.h>

namespace rnmbake {

/// One for the whole program, because signals are. The first SIGINT, SIGTERM or SIGHUP raises the flag, and
/// run_process ends its children; the second kills every running process group and this process at once.
class StopRequest {
 public:
  /// Installs the handlers. Without this call signals keep their default actions.
  static void install();

  [[nodiscard]] static bool requested() { return signal() != 0; }
  /// The first signal that came; 0: none. The program's exit code is then 128 + signal.
  [[nodiscard]] static int signal();

  /// Called before the second signal ends this process, in its handler: only async-signal-safe calls. One at
  /// a time; nullptr: none.
  static void before_kill(void (*action)());

  /// Raises the flag as a signal would; `reset` lowers it. For tests and for callers that give up on their
  /// own.
  static void request(int signal);
  static void reset();
};

/// Keeps a process group on the list of those that the second signal kills.
class RunningGroup {
 public:
  explicit RunningGroup(pid_t group);
  ~RunningGroup();
  RunningGroup(const RunningGroup&) = delete;
  RunningGroup& operator=(const RunningGroup&) = delete;

 private:
  int slot_ = -1;
};

}  // namespace rnmbake
