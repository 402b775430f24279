// trace/ray_log.h - a log of traced rays, to time Embree alone on the same ones.
#pragma once

#include "base/math.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

namespace rnmbake {

/// Keeps consecutive rays of all threads until it is full. Thread-safe.
class RayLog {
 public:
  struct Entry {
    Vec3 origin, direction;
    float to = 0;
    bool shadow = false;  // an occlusion query
  };
  explicit RayLog(std::size_t capacity) : entries_(capacity) {}

  void add(const Entry& entry) {
    const std::size_t index = next_.fetch_add(1, std::memory_order_relaxed);
    if (index < entries_.size()) entries_[index] = entry;
  }
  [[nodiscard]] std::size_t size() const { return std::min(next_.load(), entries_.size()); }
  [[nodiscard]] const Entry& operator[](std::size_t index) const { return entries_[index]; }

 private:
  std::vector<Entry> entries_;
  std::atomic<std::size_t> next_ = 0;
};

}  // namespace rnmbake
