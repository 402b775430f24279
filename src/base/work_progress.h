// base/work_progress.h - how much of the baking is done, over launches that run side by side.
#pragma once

#include "base/progress.h"

#include <cstddef>
#include <map>
#include <mutex>
#include <string>

namespace rnmbake {

/// Work is counted in texels x samples, what the time of a bake is proportional to. Thread-safe.
class WorkProgress {
 public:
  explicit WorkProgress(double total);

  /// A launch (any number that tells it apart) has done so much of its work and is at `item` now.
  void advance(std::size_t launch, double done, const std::string& item);
  /// The launch ended with so much work done that counts.
  void finish(std::size_t launch, double done);

  /// So much of the total was done before, or need not be done.
  void leave_out(double work);

  /// Says it again: one bake call lasts for minutes, and people want to see that something lives.
  void tick();

 private:
  void show();

  std::mutex mutex_;
  double total_, done_ = 0;
  std::map<std::size_t, double> running_;
  std::string item_;
  Progress progress_;
};

}  // namespace rnmbake
