// process/tree.h - what a process and everything it started use, read from /proc.
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

/// A process and what it started, told from all others also after its parents died: the group of the leader,
/// all descendants, and orphans that came to us (see adopt_orphans()) if they were members before or carry
/// the tree's mark in their environment.
class ProcessTree {
 public:
  /// `mark`: what launch_variable is set to in the tree's environment, and in no other.
  ProcessTree(pid_t leader, std::string mark) : leader_(leader), mark_(std::move(mark)) {}

  /// A look at it as it is now. Empty where there is no /proc.
  [[nodiscard]] TreeUsage look();

 private:
  struct Process;
  [[nodiscard]] bool is_ours(const Process& process) const;

  pid_t leader_;
  std::string mark_;
  std::map<pid_t, std::uint64_t> known_;  // members at the last look, and when they started
  std::set<pid_t> sessions_;              // that members began
};

/// Orphans among our descendants become our children instead of init's, so that nothing gets out of sight.
void adopt_orphans();

/// Ends what runs of this user that were killed themselves have left running: processes with a mark, whose
/// owner is gone. Returns how many.
int end_leftover_processes();

}  // namespace rnmbake
