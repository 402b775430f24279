#include "base/steps.h"

#include "base/events/log_event.h"
#include "base/log.h"
#include "base/progress.h"

#include <limits>

namespace rnmbake {

void Steps::begin(const std::string& name, double weight) {
  done_ += running_;
  running_ = weight;
  ++at_;
  const double seconds = seconds_left();
  const std::string left = seconds < 0 ? "" : fmt::format(" (about {} left)", spoken_duration(seconds));
  log::event(log::Level::info, "step", fmt::format("step {} of {}: {}{}", at_, count_, name, left),
             {{"step", std::int64_t(at_)},
              {"steps", std::int64_t(count_)},
              {"name", name},
              {"seconds_left", seconds < 0 ? std::numeric_limits<double>::quiet_NaN() : seconds}});
}

double Steps::seconds_left() const {
  constexpr double least_share = 0.1;
  return done_ < least_share * weight_ ? -1 : elapsed() * (weight_ - done_) / done_;
}

}  // namespace rnmbake
