// pipeline/farm/queue/patience.h - waiting that a signal ends.
#pragma once

#include "base/clock.h"

namespace rnmbake {

/// Throws Interrupted where the user stopped the program.
void throw_if_stopped();

/// A time to wait, from now on.
class Patience {
 public:
  explicit Patience(double seconds) : end_(steady_clock().now() + seconds) {}

  [[nodiscard]] bool is_over() const { return steady_clock().now() >= end_; }

  /// Throws Interrupted.
  static void sleep(double seconds);

 private:
  double end_;
};

}  // namespace rnmbake
