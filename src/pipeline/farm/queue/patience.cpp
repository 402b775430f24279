#include "pipeline/farm/queue/patience.h"

#include "blender/blender_session.h"
#include "process/stop.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace rnmbake {

void throw_if_stopped() {
  if (StopRequest::requested()) throw Interrupted{StopRequest::signal()};
}

void Patience::sleep(double seconds) {
  constexpr double nap = 0.05;
  const Patience time(seconds);
  do {
    throw_if_stopped();
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(nap, seconds)));
  } while (!time.is_over());
  throw_if_stopped();
}

}  // namespace rnmbake
