#include "pipeline/farm/farm_sink.h"

namespace rnmbake {

void FarmSink::take(const Batch& /*batch*/, const BatchLayout& /*layout*/,
                    std::vector<BakedPicture> /*pictures*/) {
  const std::lock_guard lock(mutex_);
  ++taken_;
}

void FarmSink::give_up(std::size_t target, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  given_up_.try_emplace(target, reason);
}

bool FarmSink::is_settled(std::size_t target) const {
  const std::lock_guard lock(mutex_);
  return given_up_.contains(target);
}

}  // namespace rnmbake
