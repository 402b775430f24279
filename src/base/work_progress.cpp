#include "base/work_progress.h"

#include "base/log.h"

namespace rnmbake {

WorkProgress::WorkProgress(double total)
    : total_(total), progress_("baking", progress_for(log::is_quiet(), log::is_jsonl())) {}

void WorkProgress::advance(std::size_t launch, double done, const std::string& item) {
  const std::lock_guard lock(mutex_);
  running_[launch] = done;
  item_ = item;
  show();
}

void WorkProgress::finish(std::size_t launch, double done) {
  const std::lock_guard lock(mutex_);
  running_.erase(launch);
  done_ += done;
  show();
}

void WorkProgress::leave_out(double work) {
  const std::lock_guard lock(mutex_);
  total_ -= work;
}

void WorkProgress::tick() {
  const std::lock_guard lock(mutex_);
  show();
}

void WorkProgress::show() {
  double done = done_;
  for (const auto& [launch, part] : running_) done += part;
  progress_.update(total_ > 0 ? done / total_ : 0, item_);
}

}  // namespace rnmbake
