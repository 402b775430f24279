// process/silence.h - tells a process that works quietly from one that hangs.
#pragma once

#include <cstddef>

namespace rnmbake {

/// Fed with what a process shows of itself, says for how long it has shown nothing: no CPU time (less than
/// `cpu_per_second` in every window of a second), no new output, nothing that the caller calls a sign of
/// life.
class SilenceWatch {
 public:
  explicit SilenceWatch(double now) : last_life_(now), window_start_(now) {}

  void observe(double now, double cpu_seconds, std::size_t output_bytes, bool other_sign_of_life);

  [[nodiscard]] double silent_seconds(double now) const { return now - last_life_; }

  static constexpr double cpu_per_second = 0.05;

 private:
  double last_life_;
  double window_start_, window_cpu_ = 0;
  std::size_t output_bytes_ = 0;
};

}  // namespace rnmbake
