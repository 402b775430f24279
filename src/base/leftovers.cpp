#include "base/leftovers.h"

#include "base/log.h"
#include "base/owner.h"

#include <fstream>
#include <mutex>
#include <set>

#include <sys/stat.h>
#include <unistd.h>

namespace rnmbake {

namespace fs = std::filesystem;

namespace {

constexpr const char* kept_mark = ".kept";

bool is_first_time(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<fs::path> swept;
  const std::lock_guard lock(mutex);
  return swept.insert(fs::absolute(folder)).second;
}

/// What stands between the beginning and the random word; "" for names of any other form.
std::string owner_in(const std::string& name, const std::string& beginning) {
  const std::size_t random = name.rfind('-');
  if (name.rfind(beginning, 0) != 0 || random <= beginning.size()) return "";
  return name.substr(beginning.size(), random - beginning.size());
}

bool is_leftover(const fs::path& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0 || status.st_uid != ::geteuid()) return false;
  const std::string name = path.filename().string();
  if (S_ISREG(status.st_mode)) return owner_is_gone(owner_in(name, leftover_file));
  return S_ISDIR(status.st_mode) && owner_is_gone(owner_in(name, leftover_folder)) &&
         ::access((path / kept_mark).c_str(), F_OK) != 0;
}

}  // namespace

void mark_as_kept(const fs::path& folder) {
  const std::ofstream mark(folder / kept_mark);
}

void sweep_leftovers(const fs::path& folder) {
  if (!is_first_time(folder)) return;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const fs::path path = it->path();
    if (!is_leftover(path)) continue;
    std::error_code refused;
    fs::remove_all(path, refused);
    log::debug("{}, left by a run that was killed, {}", path.string(),
               refused ? "cannot be removed: " + refused.message() : "was removed");
  }
}

}  // namespace rnmbake
