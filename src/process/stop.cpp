#include "process/stop.h"

#include <array>
#include <atomic>
#include <cerrno>

#include <signal.h>  // NOLINT(modernize-deprecated-headers): sigaction
#include <unistd.h>

namespace rnmbake {

namespace {

std::atomic<int> first_signal = 0;
std::array<std::atomic<pid_t>, 256> running_groups{};  // 0: free
std::atomic<void (*)()> last_action = nullptr;
static_assert(std::atomic<pid_t>::is_always_lock_free, "used in a signal handler");

// Only async-signal-safe calls here.
void on_signal(int signal) {
  const int saved = errno;
  int none = 0;
  if (!first_signal.compare_exchange_strong(none, signal)) {
    for (const auto& group : running_groups) {
      const pid_t id = group.load();
      if (id > 0) ::kill(-id, SIGKILL);
    }
    if (const auto action = last_action.load()) action();
    ::_exit(128 + signal);
  }
  errno = saved;
}

}  // namespace

void StopRequest::install() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction present {};
    // Leaves signals ignored that nohup or a script's "&" set so.
    if (::sigaction(signal, nullptr, &present) == 0 && present.sa_handler == SIG_IGN) continue;
    ::sigaction(signal, &action, nullptr);
  }
}

int StopRequest::signal() {
  return first_signal.load();
}

void StopRequest::before_kill(void (*action)()) {
  last_action.store(action);
}

void StopRequest::request(int signal) {
  int none = 0;
  first_signal.compare_exchange_strong(none, signal);
}

void StopRequest::reset() {
  first_signal.store(0);
}

RunningGroup::RunningGroup(pid_t group) {
  for (std::size_t i = 0; i < running_groups.size(); ++i) {
    pid_t free_slot = 0;
    if (running_groups[i].compare_exchange_strong(free_slot, group)) {
      slot_ = static_cast<int>(i);
      return;
    }
  }
}

RunningGroup::~RunningGroup() {
  if (slot_ >= 0) running_groups[static_cast<std::size_t>(slot_)].store(0);
}

}  // namespace rnmbake
