// process/stall.h - time that a process has spent without progress, idle or busy.
#pragma once

namespace rnmbake {

/// Sums the seconds without progress: all of the time in which the process waited for anything but a core,
/// and the CPU time of the rest. So an endless loop counts, and waiting for a core of a busy machine does
/// not.
class StallWatch {
 public:
  explicit StallWatch(double now) : last_check_(now) {}

  /// Adds an observation: seconds on the clock, CPU seconds of the whole tree so far, whether one of its
  /// threads runs or could run, whether it progressed since the last observation.
  void observe(double now, double cpu_seconds, bool wants_core, bool progressed);

  [[nodiscard]] double stalled_seconds() const { return stalled_; }

  /// Seconds between two observations that count at most: after longer gaps it was rnmbake that was
  /// suspended.
  static constexpr double longest_gap = 2;

 private:
  double last_check_, stalled_ = 0, cpu_seconds_ = 0;
};

}  // namespace rnmbake
