#include "process/silence.h"

#include <cmath>

namespace rnmbake {

void SilenceWatch::observe(double now, double cpu_seconds, std::size_t output_bytes,
                           bool other_sign_of_life) {
  if (other_sign_of_life || output_bytes != output_bytes_) last_life_ = now;
  output_bytes_ = output_bytes;
  const double window = now - window_start_;
  if (window < 1) return;
  // A fall means that a child ended whose time nobody collected: something happened, too.
  if (std::abs(cpu_seconds - window_cpu_) >= cpu_per_second * window) last_life_ = now;
  window_start_ = now;
  window_cpu_ = cpu_seconds;
}

}  // namespace rnmbake
