#include "process/tree.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include <unistd.h>

namespace rnmbake {

namespace {

struct ProcessLine {
  pid_t id = 0, parent = 0, group = 0;
  double cpu_seconds = 0;
  std::size_t resident_bytes = 0;
};

/// /proc/PID/stat, see proc(5). The name (field 2) may hold spaces and brackets, so count from the last ")".
bool read_stat(const std::filesystem::path& folder, ProcessLine& line) {
  std::ifstream stream(folder / "stat");
  std::array<char, 4096> buffer{};
  stream.read(buffer.data(), buffer.size());  // sets badbit where the process is gone; iterators would throw
  const std::string text(buffer.data(), static_cast<std::size_t>(stream.gcount()));
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return false;
  std::istringstream fields(text.substr(name_end + 1));
  std::string skipped;
  double ticks[4] = {};
  long long resident_pages = 0;
  fields >> skipped >> line.parent >> line.group;    // 3 to 5
  for (int i = 6; i <= 13; ++i) fields >> skipped;   // up to cmajflt
  for (double& t : ticks) fields >> t;               // 14 to 17: utime, stime, cutime, cstime
  for (int i = 18; i <= 23; ++i) fields >> skipped;  // up to vsize
  fields >> resident_pages;                          // 24
  if (!fields) return false;
  line.cpu_seconds = (ticks[0] + ticks[1] + ticks[2] + ticks[3]) / static_cast<double>(sysconf(_SC_CLK_TCK));
  line.resident_bytes = static_cast<std::size_t>(resident_pages * sysconf(_SC_PAGESIZE));
  return true;
}

std::vector<ProcessLine> all_processes() {
  std::vector<ProcessLine> lines;
  std::error_code error;
  for (std::filesystem::directory_iterator it("/proc", error), end; !error && it != end;
       it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    ProcessLine line;
    line.id = static_cast<pid_t>(std::strtol(name.c_str(), nullptr, 10));
    if (read_stat(it->path(), line)) lines.push_back(line);
  }
  return lines;
}

/// VmHWM: unlike ru_maxrss it starts anew with exec, so a big parent does not count.
std::size_t high_water_bytes(pid_t id) {
  std::ifstream stream("/proc/" + std::to_string(id) + "/status");
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return std::strtoull(line.c_str() + 6, nullptr, 10) * 1024;
  }
  return 0;
}

}  // namespace

TreeUsage tree_usage(pid_t leader) {
  const std::vector<ProcessLine> lines = all_processes();
  std::set<pid_t> members = {leader};
  for (const ProcessLine& line : lines) {
    if (line.group == leader) members.insert(line.id);
  }
  for (bool grew = true; grew;) {
    grew = false;
    for (const ProcessLine& line : lines) {
      if (members.count(line.parent) != 0 && members.insert(line.id).second) grew = true;
    }
  }
  TreeUsage usage;
  for (const ProcessLine& line : lines) {
    if (members.count(line.id) == 0) continue;
    usage.cpu_seconds += line.cpu_seconds;
    usage.resident_bytes += line.resident_bytes;
    usage.peak_bytes = std::max(usage.peak_bytes, high_water_bytes(line.id));
    usage.members.push_back(line.id);
  }
  return usage;
}

}  // namespace rnmbake
