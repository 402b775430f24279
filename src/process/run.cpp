#include "process/run.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/files.h"
#include "base/owner.h"
#include "process/spawn.h"
#include "process/stall.h"
#include "process/stop.h"
#include "process/tree.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <thread>

#include <fcntl.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): kill
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rnmbake {

namespace {

constexpr double nap_seconds = 0.01;  // how late an end may be noticed
constexpr int patience = 500;         // naps: a process that survives SIGKILL for 5 s waits for a disk

/// The file that takes stdout and stderr; without a name it is unlinked at once and read back at the end.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path) {
    std::string name = path.string();
    if (name.empty()) {
      name = (temp_root() / "rnmbake-output-XXXXXX").string();
      descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
      if (descriptor_ >= 0) ::unlink(name.c_str());
    } else {
      descriptor_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
    }
    if (descriptor_ < 0) {
      fail(ExitCode::io, "cannot write {}: {}", name, std::strerror(errno));  // NOLINT(concurrency-mt-unsafe)
    }
  }
  ~OutputFile() { ::close(descriptor_); }
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }

  [[nodiscard]] std::size_t size() const {
    struct stat status {};
    return ::fstat(descriptor_, &status) == 0 ? static_cast<std::size_t>(status.st_size) : 0;
  }

  [[nodiscard]] std::string content() const {
    std::string text(size(), '\0');
    const ssize_t got = ::pread(descriptor_, text.data(), text.size(), 0);
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return text;
  }

 private:
  int descriptor_ = -1;
};

std::string new_mark() {
  static std::atomic<unsigned> number = 0;
  return owner_word() + '/' + std::to_string(number++);
}

ProcessOptions with_mark(ProcessOptions options, const std::string& mark) {
  options.environment.emplace_back(launch_variable, mark);
  return options;
}

/// One child from its start to its end.
class Run {
 public:
  Run(const ProcessOptions& options, const ProcessTick& tick)
      : options_(options),
        tick_(tick),
        output_(options.output),
        started_(steady_clock().now()),
        stall_(started_),
        mark_(new_mark()),
        leader_(spawn(with_mark(options, mark_), output_.descriptor())),
        tree_(leader_, mark_),
        group_(leader_) {}

  /// Ends the child where an exception left it alive.
  ~Run() {
    if (!reaped_) {
      end_tree();
      reap();
    }
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  ProcessResult to_the_end() {
    // Memory may grow by gigabytes in a second.
    const double tick =
        options_.memory_bytes > 0 ? std::min(0.1, options_.tick_seconds) : options_.tick_seconds;
    double next_look = elapsed() + std::min(0.03, tick);
    while (!ended()) {
      if (elapsed() >= next_look) {
        look();
        next_look = elapsed() + tick;
      }
      enforce_limits();
      nap();
    }
    end_tree();  // descendants that outlived the leader
    reap();
    result_.wall_seconds = elapsed();
    if (tick_) tick_({result_.wall_seconds, result_.cpu_seconds, 0, output_.size()});
    if (options_.output.empty()) result_.output = output_.content();
    return std::move(result_);
  }

 private:
  [[nodiscard]] double elapsed() const { return steady_clock().now() - started_; }

  static void nap() { std::this_thread::sleep_for(std::chrono::duration<double>(nap_seconds)); }

  /// Ended but not reaped: its number, and with it the group's, cannot be given to somebody else yet.
  [[nodiscard]] bool ended() const {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(leader_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == leader_;
  }

  void look() {
    const TreeUsage usage = tree_.look();
    result_.cpu_seconds = std::max(result_.cpu_seconds, usage.cpu_seconds);
    result_.peak_bytes = std::max({result_.peak_bytes, usage.peak_bytes, usage.resident_bytes});
    resident_bytes_ = usage.resident_bytes;
    const std::size_t bytes = output_.size();
    const bool progressed = tick_ && tick_({elapsed(), usage.cpu_seconds, usage.resident_bytes, bytes});
    stall_.observe(steady_clock().now(), usage.cpu_seconds, usage.wants_core, progressed);
  }

  void enforce_limits() {
    using By = ProcessResult::EndedBy;
    const double now = steady_clock().now();
    if (StopRequest::requested()) {
      end(By::stop_request);
    } else if (options_.total_seconds > 0 && now - started_ > options_.total_seconds) {
      end(By::total_limit);
    } else if (options_.stall_seconds > 0 && stall_.stalled_seconds() > options_.stall_seconds) {
      end(By::stall);
    } else if (options_.output_bytes > 0 && output_.size() > options_.output_bytes) {
      end(By::output_limit);
    } else if (options_.memory_bytes > 0 && resident_bytes_ > options_.memory_bytes) {
      end(By::memory_limit);
    }
  }

  /// SIGTERM to all, SIGKILL after the grace period; at once where memory would go on growing.
  void end(ProcessResult::EndedBy why) {
    if (!ending_since_) {
      ending_since_ = elapsed();
      result_.ended_by = why;
      signal_tree(SIGTERM);
      signal_tree(SIGCONT);  // a stopped process would not notice
      if (why == ProcessResult::EndedBy::memory_limit) signal_tree(SIGKILL);
    } else if (elapsed() - *ending_since_ > options_.grace_seconds) {
      signal_tree(SIGKILL);
    }
  }

  /// Kills until no process is left: children that a process forks before it dies come to us as orphans.
  void end_tree() {
    for (int i = 0; i < patience; ++i) {
      const std::vector<pid_t> left = signal_tree(SIGKILL);
      if (std::all_of(left.begin(), left.end(), [&](pid_t id) { return id == leader_ && ended(); })) return;
      nap();
    }
  }

  /// Signals the group and the processes that left it. Returns their ids, without those of dead ones.
  std::vector<pid_t> signal_tree(int signal) {
    std::vector<pid_t> members = tree_.look().members;  // before anyone becomes an orphan
    ::kill(-leader_, signal);
    std::erase_if(members, [&](pid_t id) {
      if (id == leader_) return false;
      if (::waitpid(id, nullptr, WNOHANG) == id) return true;  // an orphan of ours now
      ::kill(id, signal);
      return false;
    });
    return members;
  }

  void reap() {
    int status = 0;
    rusage usage{};
    while (::wait4(leader_, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    reaped_ = true;
    if (WIFSIGNALED(status)) {
      result_.signal = WTERMSIG(status);
    } else {
      result_.exit_code = WEXITSTATUS(status);
    }
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    result_.cpu_seconds = std::max(result_.cpu_seconds, seconds(usage.ru_utime) + seconds(usage.ru_stime));
    // ru_maxrss counts what we held at the fork, so it is second choice.
    if (result_.peak_bytes == 0) result_.peak_bytes = static_cast<std::size_t>(usage.ru_maxrss) * 1024;
  }

  const ProcessOptions& options_;
  const ProcessTick& tick_;
  OutputFile output_;
  double started_;
  StallWatch stall_;
  std::string mark_;
  pid_t leader_;
  ProcessTree tree_;
  RunningGroup group_;
  std::optional<double> ending_since_;
  bool reaped_ = false;
  std::size_t resident_bytes_ = 0;  // at the last look
  ProcessResult result_;
};

}  // namespace

ProcessResult run_process(const ProcessOptions& options, const ProcessTick& tick) {
  return Run(options, tick).to_the_end();
}

std::string signal_name(int signal) {
  const char* abbreviation = ::sigabbrev_np(signal);
  return abbreviation != nullptr ? std::string("SIG") + abbreviation : fmt::format("signal {}", signal);
}

}  // namespace rnmbake
