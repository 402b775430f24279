#include "jobs/jobserver.h"

#include "process/stop.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rnmbake {
namespace {

constexpr int no_token = 0;

// What the signal handler gives back. A token is the byte that was read, and that same byte goes back.
// It is stored plus one, so that 0 is none.
std::array<std::atomic<int>, 256> tokens{};
std::atomic<int> tokens_writer = -1;
static_assert(std::atomic<int>::is_always_lock_free, "used in a signal handler");

/// Gives back the token of this place, if there is one. Only async-signal-safe calls.
bool give_back(std::atomic<int>& place) {
  const int token = place.exchange(no_token);
  if (token == no_token) return false;
  const char byte = static_cast<char>(token - 1);
  while (::write(tokens_writer.load(), &byte, 1) < 0 && errno == EINTR) {
  }
  return true;
}

void give_all_back() {
  for (auto& place : tokens) give_back(place);
}

/// Value of the last option of that name: make appends.
std::string last_value(std::string_view flags, std::string_view option) {
  const auto at = flags.rfind(option);
  if (at == std::string_view::npos) return "";
  const std::string_view rest = flags.substr(at + option.size());
  return std::string(rest.substr(0, rest.find(' ')));
}

bool is_pipe(int descriptor) {
  struct stat about {};
  return ::fstat(descriptor, &about) == 0 && S_ISFIFO(about.st_mode);
}

/// "3,4" of two descriptors that are open, else nothing.
std::optional<std::pair<int, int>> pipe_of(const std::string& value) {
  int ends[2] = {-1, -1};
  const char *at = value.data(), *end = at + value.size();
  for (int& one : ends) {
    const auto [behind, error] = std::from_chars(at, end, one);
    if (error != std::errc{} || one < 0 || !is_pipe(one)) return std::nullopt;
    at = behind < end ? behind + 1 : behind;
  }
  return std::pair(ends[0], ends[1]);
}

std::string_view makeflags_of_environment() {
  const char* flags = std::getenv("MAKEFLAGS");
  return flags == nullptr ? "" : flags;
}

}  // namespace

Jobserver::Jobserver(std::string_view makeflags) {
  std::string value = last_value(makeflags, "--jobserver-auth=");
  if (value.empty()) value = last_value(makeflags, "--jobserver-fds=");  // before GNU make 4.2
  if (value.starts_with("fifo:")) {
    const std::string path = value.substr(5);
    reader_ = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (reader_ >= 0 && !is_pipe(reader_)) ::close(std::exchange(reader_, -1));
    if (reader_ >= 0) writer_ = ::fcntl(reader_, F_DUPFD_CLOEXEC, 0);
  } else if (const auto ends = pipe_of(value)) {
    // A description of our own: O_NONBLOCK on make's would change what its other children wait on.
    reader_ =
        ::open(("/proc/self/fd/" + std::to_string(ends->first)).c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (reader_ >= 0) writer_ = ::fcntl(ends->second, F_DUPFD_CLOEXEC, 0);
  }
  if (reader_ >= 0 && writer_ < 0) ::close(std::exchange(reader_, -1));
  if (!connected()) return;
  tokens_writer = writer_;
  StopRequest::before_kill(give_all_back);
}

Jobserver::Jobserver() : Jobserver(makeflags_of_environment()) {}

Jobserver::~Jobserver() {
  if (!connected()) return;
  give_all_back();
  StopRequest::before_kill(nullptr);
  ::close(reader_);
  ::close(writer_);
}

bool Jobserver::try_acquire() {
  if (!connected()) return false;
  char byte = 0;
  ssize_t got = 0;
  while ((got = ::read(reader_, &byte, 1)) < 0 && errno == EINTR) {
  }
  if (got != 1) return false;
  for (auto& place : tokens) {
    int none = no_token;
    if (place.compare_exchange_strong(none, static_cast<unsigned char>(byte) + 1)) return true;
  }
  while (::write(writer_, &byte, 1) < 0 && errno == EINTR) {
  }
  return false;  // as many as anybody starts
}

void Jobserver::release() {
  for (auto& place : tokens) {
    if (connected() && give_back(place)) return;
  }
}

int Jobserver::held() const {
  int count = 0;
  for (const auto& place : tokens) count += place.load() != no_token ? 1 : 0;
  return count;
}

int jobs_granted(Jobserver& server, int wanted) {
  if (!server.connected()) return wanted;
  int jobs = 1;
  while (jobs < wanted && server.try_acquire()) ++jobs;
  return jobs;
}

}  // namespace rnmbake
