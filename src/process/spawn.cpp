#include "process/spawn.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>

#include <fcntl.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): sigset_t
#include <sys/wait.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "base/error.h"
#include "process/tree.h"

extern char** environ;  // NOLINT(readability-redundant-declaration): not every libc declares it

namespace rnmbake {

namespace {

std::vector<std::string> changed_environment(const ProcessOptions& options) {
  std::map<std::string, std::string> variables;
  for (char** entry = environ; *entry != nullptr && !options.bare; ++entry) {
    const std::string text = *entry;
    const std::size_t equals = text.find('=');
    if (equals != std::string::npos) variables[text.substr(0, equals)] = text.substr(equals + 1);
  }
  for (const auto& [name, value] : options.environment) {
    if (value) {
      variables[name] = *value;
    } else {
      variables.erase(name);
    }
  }
  std::vector<std::string> lines;
  lines.reserve(variables.size());
  for (const auto& [name, value] : variables) lines.push_back(fmt::format("{}={}", name, value));
  return lines;
}

std::string in_path(const std::string& program) {
  if (program.find('/') != std::string::npos) return program;
  const char* path = std::getenv("PATH");
  std::string rest = path != nullptr ? path : "/usr/bin:/bin";
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    std::string candidate = rest.substr(0, colon) + '/' + program;
    if (::access(candidate.c_str(), X_OK) == 0) return candidate;
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  }
  return program;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> out;
  out.reserve(texts.size() + 1);
  for (std::string& text : texts) out.push_back(text.data());
  out.push_back(nullptr);
  return out;
}

struct ChildPlan {
  const char* program;
  char** argv;
  char** environment;
  const char* folder;  // null: stay
  int input, output, report;
  pid_t parent;
};

void reset_signals() {
  struct sigaction standard {};
  standard.sa_handler = SIG_DFL;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE})
    ::sigaction(signal, &standard, nullptr);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// Files that other threads' libraries opened without O_CLOEXEC are not for a program that we start.
void leave_files_behind() {
#ifdef CLOSE_RANGE_CLOEXEC
  ::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
#endif
}

/// Between fork and exec: other threads' locks may be held for ever, so only async-signal-safe calls.
[[noreturn]] void become(const ChildPlan& plan) {
  ::setpgid(0, 0);
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != plan.parent) ::_exit(127);  // the parent died before the line above
#endif
  reset_signals();
  leave_files_behind();
  const bool ready = ::dup2(plan.input, STDIN_FILENO) >= 0 && ::dup2(plan.output, STDOUT_FILENO) >= 0 &&
                     ::dup2(plan.output, STDERR_FILENO) >= 0 &&
                     (plan.folder == nullptr || ::chdir(plan.folder) == 0);
  if (ready) ::execve(plan.program, plan.argv, plan.environment);
  const int error = errno;
  const ssize_t told = ::write(plan.report, &error, sizeof error);
  ::_exit(told == sizeof error ? 127 : 126);
}

/// A descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return value_; }
  void close() {
    if (value_ >= 0) ::close(value_);
    value_ = -1;
  }

 private:
  int value_;
};

[[noreturn]] void fail_starting(const std::string& program, int error) {
  fail(ExitCode::environment, "cannot start {}: {}", program,
       std::strerror(error));  // NOLINT(concurrency-mt-unsafe)
}

}  // namespace

pid_t spawn(const ProcessOptions& options, int output_descriptor) {
  std::vector<std::string> arguments = options.argv, variables = changed_environment(options);
  const std::vector<char*> argv = pointers(arguments), environment = pointers(variables);
  const std::string program = in_path(options.argv.at(0));
  const std::string folder = options.folder.string();
  int report[2];
  if (::pipe2(report, O_CLOEXEC) != 0) fail_starting(program, errno);
  const Descriptor report_in(report[0]);
  Descriptor report_out(report[1]);
  const Descriptor nothing(::open("/dev/null", O_RDONLY | O_CLOEXEC));

  const ChildPlan plan{program.c_str(),
                       const_cast<char**>(argv.data()),
                       const_cast<char**>(environment.data()),
                       folder.empty() ? nullptr : folder.c_str(),
                       nothing.get(),
                       output_descriptor,
                       report[1],
                       ::getpid()};
  adopt_orphans();
  const pid_t child = ::fork();
  if (child < 0) fail_starting(program, errno);
  if (child == 0) become(plan);
  ::setpgid(child, child);  // both sides, so that neither can come too early
  report_out.close();
  int error = 0;
  ssize_t got = 0;
  do {
    got = ::read(report_in.get(), &error, sizeof error);
  } while (got < 0 && errno == EINTR);
  if (got == sizeof error) {
    ::waitpid(child, nullptr, 0);
    fail_starting(program, error);
  }
  return child;
}

}  // namespace rnmbake
