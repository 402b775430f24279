#include "process/tree.h"

#include "base/owner.h"
#include "base/process_stat.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <signal.h>  // NOLINT(modernize-deprecated-headers): kill
#include <sys/stat.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace rnmbake {

namespace fs = std::filesystem;

struct ProcessTree::Process {
  pid_t id = 0;
  ProcessStat stat;
};

namespace {

bool is_number(const std::string& name) {
  return name.find_first_not_of("0123456789") == std::string::npos;
}

std::vector<pid_t> numbers_in(const fs::path& folder) {
  std::vector<pid_t> numbers;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (is_number(name)) numbers.push_back(static_cast<pid_t>(std::strtol(name.c_str(), nullptr, 10)));
  }
  return numbers;
}

fs::path folder_of(pid_t id) {
  return "/proc/" + std::to_string(id);
}

/// VmHWM: unlike ru_maxrss it starts anew with exec, so a big parent does not count.
std::size_t high_water_bytes(pid_t id) {
  std::ifstream stream(folder_of(id) / "status");
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return std::strtoull(line.c_str() + 6, nullptr, 10) * 1024;
  }
  return 0;
}

bool wants_core(pid_t id) {
  const fs::path threads = folder_of(id) / "task";
  const std::vector<pid_t> all = numbers_in(threads);
  return std::any_of(all.begin(), all.end(), [&](pid_t thread) {
    const auto stat = read_process_stat(threads / std::to_string(thread));
    return stat && stat->state == 'R';
  });
}

/// "" where there is none, or where the environment is not ours to read.
std::string mark_of(pid_t id) {
  const std::string beginning = launch_variable + std::string("=");
  std::ifstream stream(folder_of(id) / "environ", std::ios::binary);
  for (std::string line; std::getline(stream, line, '\0');) {
    if (line.rfind(beginning, 0) == 0) return line.substr(beginning.size());
  }
  return "";
}

}  // namespace

bool ProcessTree::is_ours(const Process& process) const {
  if (process.id == leader_ || process.stat.group == leader_) return true;
  if (sessions_.count(process.stat.session) != 0) return true;
  const auto known = known_.find(process.id);
  if (known != known_.end() && known->second == process.stat.start_ticks) return true;
  return process.stat.parent == ::getpid() && mark_of(process.id) == mark_;
}

TreeUsage ProcessTree::look() {
  std::vector<Process> processes;
  for (const pid_t id : numbers_in("/proc")) {
    if (const auto stat = read_process_stat(folder_of(id))) processes.push_back({id, *stat});
  }
  std::set<pid_t> members;
  for (const Process& process : processes) {
    if (is_ours(process)) members.insert(process.id);
  }
  for (bool grew = true; grew;) {
    grew = false;
    for (const Process& process : processes) {
      if (members.count(process.stat.parent) != 0 && members.insert(process.id).second) grew = true;
    }
  }
  TreeUsage usage;
  known_.clear();
  for (const auto& [id, stat] : processes) {
    if (members.count(id) == 0) continue;
    known_[id] = stat.start_ticks;
    if (stat.session == id) sessions_.insert(id);
    usage.cpu_seconds += stat.cpu_seconds;
    usage.resident_bytes += stat.resident_bytes;
    usage.peak_bytes = std::max(usage.peak_bytes, high_water_bytes(id));
    usage.wants_core = usage.wants_core || wants_core(id);
    usage.members.push_back(id);
  }
  return usage;
}

void adopt_orphans() {
#ifdef PR_SET_CHILD_SUBREAPER
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
#endif
}

int end_leftover_processes() {
  int ended = 0;
  for (const pid_t id : numbers_in("/proc")) {
    struct stat status {};
    if (::stat(folder_of(id).c_str(), &status) != 0 || status.st_uid != ::geteuid()) continue;
    const std::string mark = mark_of(id);
    if (owner_is_gone(mark.substr(0, mark.find('/'))) && ::kill(id, SIGKILL) == 0) ++ended;
  }
  return ended;
}

}  // namespace rnmbake
