// base/steps.h - says which of several long steps is at work, and how long the rest may take.
#pragma once

#include "base/clock.h"

#include <cstddef>
#include <string>

namespace rnmbake {

/// Weights are about proportional to time. The estimate is by rule of three over what is done, once that is a
/// tenth of all.
class Steps {
 public:
  Steps(std::size_t count, double weight, const Clock& clock = steady_clock())
      : count_(count), weight_(weight), clock_(clock), started_(clock.now()) {}

  /// Logs "step 3 of 9: NAME (about 4 min left)"; the step before is done by that.
  void begin(const std::string& name, double weight);

  [[nodiscard]] double elapsed() const { return clock_.now() - started_; }

  /// For the step that has begun and those after it; negative while nothing can be said.
  [[nodiscard]] double seconds_left() const;

 private:
  std::size_t count_, at_ = 0;
  double weight_, done_ = 0, running_ = 0;
  const Clock& clock_;
  double started_;
};

}  // namespace rnmbake
