#include "base/steps.h"

#include "base/log.h"
#include "base/progress.h"

namespace rnmbake {

void Steps::begin(const std::string& name, double weight) {
  done_ += running_;
  running_ = weight;
  ++at_;
  const double seconds = seconds_left();
  const std::string left = seconds < 0 ? "" : fmt::format(" (about {} left)", spoken_duration(seconds));
  log::info("step {} of {}: {}{}", at_, count_, name, left);
}

double Steps::seconds_left() const {
  constexpr double least_share = 0.1;
  return done_ < least_share * weight_ ? -1 : elapsed() * (weight_ - done_) / done_;
}

}  // namespace rnmbake
