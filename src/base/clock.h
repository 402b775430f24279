// base/clock.h - seconds that only go forward, replaceable where a test must not wait.
#pragma once

#include <chrono>

namespace rnmbake {

class Clock {
 public:
  virtual ~Clock() = default;
  /// Seconds since some fixed moment.
  [[nodiscard]] virtual double now() const = 0;
};

class SteadyClock : public Clock {
 public:
  [[nodiscard]] double now() const override {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
};

/// The clock for everybody who does not bring one.
inline const Clock& steady_clock() {
  static const SteadyClock clock;
  return clock;
}

}  // namespace rnmbake
