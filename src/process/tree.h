// process/tree.h - resources of a process and its descendants, read from /proc.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <sys/types.h>

namespace rnmbake {

/// In the environment of every process that we start: owner_word(), "/" and a number.
inline constexpr const char* launch_variable = "RNMBAKE_LAUNCHED_BY";

struct TreeUsage {
  double cpu_seconds = 0;          // user + system, with children that were already waited for
  std::size_t resident_bytes = 0;  // now, of all together (shared pages count more than once)
  std::size_t peak_bytes = 0;      // the largest resident size that any one of them ever had
  bool wants_core = false;         // a thread runs, or waits for nothing but a core
  std::vector<pid_t> members;      // dead ones that nobody waited for, too
};

/// A process with its descendants, also after their parents' deaths: the group of the leader, all
/// descendants, and orphans that came to us (see adopt_orphans()) if they were members before or carry the
/// tree's mark in their environment.
class ProcessTree {
 public:
  /// `mark`: value of launch_variable in the tree's environment, and in no other.
  ProcessTree(pid_t leader, std::string mark) : leader_(leader), mark_(std::move(mark)) {}

  /// Measures the tree now. Empty where there is no /proc.
  [[nodiscard]] TreeUsage look();

 private:
  struct Process;
  [[nodiscard]] bool is_ours(const Process& process) const;

  pid_t leader_;
  std::string mark_;
  std::map<pid_t, std::uint64_t> known_;  // members at the last look, and when they started
  std::set<pid_t> sessions_;              // that members began
};

/// Makes orphans among our descendants our children instead of init's, so that the tree stays known.
void adopt_orphans();

/// Ends processes that killed runs of this user left behind: those with a mark whose owner is gone. Returns
/// their number.
int end_leftover_processes();

}  // namespace rnmbake
