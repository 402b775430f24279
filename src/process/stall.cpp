#include "process/stall.h"

#include <algorithm>

namespace rnmbake {

void StallWatch::observe(double now, double cpu_seconds, bool wants_core, bool progressed) {
  const double passed = std::min(now - last_check_, longest_gap);
  // Negative where a child ended whose time nobody collected.
  const double computed = std::clamp(cpu_seconds - cpu_seconds_, 0.0, passed);
  stalled_ = progressed ? 0 : stalled_ + (wants_core ? computed : passed);
  last_check_ = now;
  cpu_seconds_ = cpu_seconds;
}

}  // namespace rnmbake
