// process/tree.h - what a process and everything it started use, read from /proc.
#pragma once

#include <cstddef>
#include <vector>

#include <sys/types.h>

namespace rnmbake {

struct TreeUsage {
  double cpu_seconds = 0;          // user + system, with children that were already waited for
  std::size_t resident_bytes = 0;  // now, of all together (shared pages count more than once)
  std::size_t peak_bytes = 0;      // the largest resident size that any one of them ever had
  std::vector<pid_t> members;      // of the group, or descending from its leader
};

/// The process group of `leader` and the leader's descendants, even those that left the group. Empty where
/// there is no /proc.
TreeUsage tree_usage(pid_t leader);

}  // namespace rnmbake
