#include "pipeline/steps.h"

#include "base/log.h"
#include "base/progress.h"

namespace rnmbake {

void Steps::begin(const std::string& name, double weight) {
  done_ += running_;
  running_ = weight;
  ++at_;
  const std::string left =
      done_ > 0 ? fmt::format(" (about {} left)", spoken_duration(elapsed() * (weight_ - done_) / done_))
                : "";
  log::info("step {} of {}: {}{}", at_, count_, name, left);
}

}  // namespace rnmbake
