// process/stall.h - tells a process that gets on from one that hangs, idle or busy.
#pragma once

namespace rnmbake {

/// Adds up for how long a process has got nowhere since its last progress: all the time in which it waited
/// for anything but a core, and of the time in which it wanted one, no more than what it was given. So a
/// loop without end counts, and waiting for others on a crowded machine does not.
class StallWatch {
 public:
  explicit StallWatch(double now) : last_check_(now) {}

  /// A look at the process: seconds on the clock, CPU seconds of its whole tree so far, whether one of its
  /// threads runs or could, whether it progressed since the last look.
  void observe(double now, double cpu_seconds, bool wants_core, bool progressed);

  [[nodiscard]] double stalled_seconds() const { return stalled_; }

  /// Between two looks; what is longer says that we were stopped, and nothing about the process.
  static constexpr double longest_gap = 2;

 private:
  double last_check_, stalled_ = 0, cpu_seconds_ = 0;
};

}  // namespace rnmbake
