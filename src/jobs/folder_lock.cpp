#include "jobs/folder_lock.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/log.h"
#include "base/owner.h"
#include "base/read_file.h"
#include "base/text.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rnmbake {

namespace fs = std::filesystem;

namespace {

constexpr double longest_nap = 0.5;  // seconds between two looks at a lock that somebody holds

std::string host_name() {
  char name[256] = {};
  ::gethostname(name, sizeof name - 1);
  return name;
}

std::string time_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::localtime_r(&now, &parts);
  char text[64] = {};
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S %z", &parts);
  return text;
}

std::string holder_text(const std::string& command) {
  std::string line = command;
  std::replace(line.begin(), line.end(), '\n', ' ');
  return fmt::format("host {}\nprocess {}\nsince {}\ncommand {}\nowner {}\n", host_name(), ::getpid(),
                     time_now(), line, owner_word());
}

std::string describe(const LockHolder& holder) {
  if (holder.process.empty()) return "another run of rnmbake, which has only just begun";
  return printable(fmt::format("process {} on {} since {} ({})", holder.process, holder.host, holder.since,
                               holder.command));
}

/// The holder's text is for people who look; whether there is a lock does not hang on it.
void write_holder(int descriptor, const std::string& command) {
  const std::string text = holder_text(command);
  const bool written = ::ftruncate(descriptor, 0) == 0 &&
                       ::pwrite(descriptor, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size());
  if (!written) log::debug("the lock does not say who holds it: {}", std::strerror(errno));
}

/// Opened for reading where the file is another user's: flock is content with that.
int open_lock(const fs::path& file) {
  const int flags = O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
  const int descriptor = ::open(file.c_str(), O_RDWR | flags, 0666);
  if (descriptor >= 0 || errno != EACCES) return descriptor;
  const int readable = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (readable < 0) errno = EACCES;
  return readable;
}

/// Whether the name still stands for the open file: who held it before may have removed it in between.
bool is_still_there(int descriptor, const fs::path& file) {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::lstat(file.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

/// One try to take the lock.
struct Try {
  int descriptor = -1;  // held
  int error = 0;        // EWOULDBLOCK: another holds it
};

Try try_to_lock(const fs::path& file) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    const int descriptor = open_lock(file);
    if (descriptor < 0) return {-1, errno};
    int result = 0;
    do {
      result = ::flock(descriptor, LOCK_EX | LOCK_NB);
    } while (result != 0 && errno == EINTR);
    if (result == 0 && is_still_there(descriptor, file)) return {descriptor, 0};
    const int error = errno;
    ::close(descriptor);
    if (result != 0) return {-1, error};
  }
  return {-1, ESTALE};  // a file system whose files never are who they were
}

}  // namespace

LockHolder read_holder(const fs::path& lock_file) {
  std::string text;
  try {
    text = read_part(lock_file, 0, 1 << 16);
  } catch (const Error&) {  // gone meanwhile, or not to be read
  }
  LockHolder holder;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    const std::size_t blank = std::min(line.find(' '), line.size());
    const std::string_view name = line.substr(0, blank);
    const std::string value(line.substr(std::min(line.size(), blank + 1)));
    if (name == "host") holder.host = value;
    if (name == "process") holder.process = value;
    if (name == "since") holder.since = value;
    if (name == "command") holder.command = value;
  }
  return holder;
}

FolderLock::FolderLock(const fs::path& folder, const FolderLockOptions& options) : file_(folder / file_name) {
  const double begin = steady_clock().now();
  bool has_said = false;
  double nap = 0.02;
  while (true) {
    const Try result = try_to_lock(file_);
    descriptor_ = result.descriptor;
    if (descriptor_ >= 0) break;
    if (result.error != EWOULDBLOCK) {
      log::warn("cannot lock {}: {}; see to it that no other rnmbake writes there at the same time",
                folder.string(), std::strerror(result.error));
      return;
    }
    const double left = options.wait_seconds - (steady_clock().now() - begin);
    const std::string holder = describe(read_holder(file_));
    if (left <= 0 || (options.stop && options.stop())) {
      fail(ExitCode::lock_held,
           "{} is being written to by {}; {}--lock-wait SECONDS waits, -o DIR names another folder",
           folder.string(), holder,
           options.wait_seconds > 0 ? fmt::format("waited {:g} seconds; ", options.wait_seconds) : "");
    }
    if (!has_said) {
      log::info("{} is being written to by {}; waiting up to {:g} seconds", folder.string(), holder,
                options.wait_seconds);
      has_said = true;
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(nap, left)));
    nap = std::min(2 * nap, longest_nap);
  }
  write_holder(descriptor_, options.command);
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

FolderLock::~FolderLock() {
  if (descriptor_ < 0) return;
  ::unlink(file_.c_str());  // while it is held, so that nobody's file but this one goes
  ::close(descriptor_);
}

}  // namespace rnmbake
