#include "base/machine.h"

#include <algorithm>
#include <fstream>

#include <unistd.h>

namespace rnmbake {

std::uint64_t machine_memory() {
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::uint64_t memory_limit() {
  // version 2 of control groups, then version 1
  for (const char* file : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::ifstream stream(file);
    std::uint64_t bytes = 0;
    if (stream >> bytes && bytes < std::uint64_t{1} << 60) return bytes;
  }
  return 0;
}

std::uint64_t usable_memory() {
  const std::uint64_t limit = memory_limit();
  return limit == 0 ? machine_memory() : std::min(limit, machine_memory());
}

}  // namespace rnmbake
