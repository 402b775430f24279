#include "jobs/store.h"

#include "base/disk.h"
#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "jobs/entry.h"
#include "jobs/store_folder.h"
#include "jobs/upkeep.h"

#include <chrono>
#include <cstdlib>
#include <set>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>

namespace rnmbake {

namespace fs = std::filesystem;

namespace {

/// Once in a run: several stores may stand for one folder.
template <typename... Args>
void warn_once(const std::string& topic, fmt::format_string<Args...> format, Args&&... args) {
  static std::mutex mutex;
  static std::set<std::string> topics;
  const std::lock_guard lock(mutex);
  if (topics.insert(topic).second) log::warn("{}", fmt::format(format, std::forward<Args>(args)...));
}

/// Not more often than hourly, so that reading a shared folder seldom writes to it.
void mark_as_used(const fs::path& file, std::int64_t modified) {
  constexpr std::int64_t hour = std::int64_t{3600} * 1'000'000'000;
  const std::int64_t now = std::chrono::duration_cast<std::chrono::nanoseconds>(
                               std::chrono::system_clock::now().time_since_epoch())
                               .count();
  // By the server's clock, and allowed to everybody who may write to the file; where not, it only seems
  // older.
  if (std::abs(now - modified) > hour) ::utimensat(AT_FDCWD, file.c_str(), nullptr, 0);
}

/// With the names of all new folders safe on the disk.
void make_entry_folder(const fs::path& folder, const fs::path& store) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return;
  make_folders(folder);
  sync_folder(folder.parent_path());
  sync_folder(store);
}

}  // namespace

Store::Store(fs::path folder, std::int64_t limit)
    : folder_(std::move(folder)), limit_(limit), size_(folder_, limit) {}

Store::~Store() {
  const std::lock_guard lock(mutex_);
  if (keeps() && limit_ > 0) size_.flush();
}

fs::path Store::file_of(const ResultKey& key) const {
  return entry_path(folder_, key);
}

std::optional<std::string> Store::get(const ResultKey& key) {
  if (folder_.empty()) return std::nullopt;
  const fs::path file = file_of(key);
  EntryRead read = read_entry(file, key);
  if (read.payload) {
    mark_as_used(file, read.state.modified);
  } else if (!read.damage.empty()) {
    remove_entry(file, read.state);
    warn_once(file.string(), "{}: {}; it is made again", file.string(), read.damage);
  } else if (!read.unreadable.empty()) {
    warn_once(
        "read " + folder_.string(),
        "cannot read {}: {}; what cannot be read is made again; give this user access to the cache, or name "
        "another with --cache",
        file.string(), read.unreadable);
  }
  return std::move(read.payload);
}

bool Store::has(const ResultKey& key) const {
  std::error_code error;
  return !folder_.empty() && fs::exists(file_of(key), error);
}

void Store::put(const ResultKey& key, std::string_view bytes) {
  if (!keeps()) return;
  try {
    keep(key, bytes);
  } catch (const Error& error) {
    warn_once("write " + folder_.string(),
              "{}: results are not kept, and the run goes on; --cache DIR names another folder, --cache none "
              "keeps nothing",
              error.what());
  }
}

void Store::keep(const ResultKey& key, std::string_view bytes) {
  const std::string header = entry_header(key, bytes);
  const auto size = static_cast<std::int64_t>(header.size() + bytes.size());
  if (!prepare_folder() || has(key)) return;
  if (limit_ > 0 && size > limit_ / 10 * 9) {
    warn_once("large " + folder_.string(),
              "a result of {} MiB is not kept: it does not fit into {}; raise --cache-limit", size >> 20,
              folder_.string());
    return;
  }
  make_room(size);
  const fs::path file = file_of(key);
  make_entry_folder(file.parent_path(), folder_);
  AtomicFile entry(file);
  try {
    entry.write(header);
    entry.write(bytes);
    entry.commit();
  } catch (const Error&) {
    // What little room is left, once the temporary file is gone, belongs to what the user asked for.
    if (disk_is_full(folder_)) given_up_ = true;
    throw;
  }
  if (limit_ <= 0) return;
  const std::lock_guard lock(mutex_);
  size_.add(size);
}

void Store::remove(const ResultKey& key) {
  std::error_code error;
  if (!folder_.empty()) fs::remove(file_of(key), error);
}

bool Store::prepare_folder() {
  const std::lock_guard lock(mutex_);
  if (given_up_) return false;
  const StoreFolder state = look_at_store_folder(folder_);
  if (state == StoreFolder::absent) make_store_folder(folder_);
  if (state == StoreFolder::absent || state == StoreFolder::ours) return true;
  given_up_ = true;
  warn_once("write " + folder_.string(),
            "{} is {}: results are not kept, and the run goes on; name a new or empty folder with --cache",
            folder_.string(),
            state == StoreFolder::other ? "a cache of another version of rnmbake"
                                        : "no cache of rnmbake and not empty");
  return false;
}

void Store::make_room(std::int64_t bytes) {
  if (limit_ <= 0) return;
  const std::lock_guard lock(mutex_);
  const auto known = size_.bytes();
  if (known && *known + bytes <= limit_) return;
  StoreContents contents = list_store(folder_);
  std::int64_t present = contents.bytes;
  if (present + bytes > limit_) {
    const TrimCounts counts = trim_results(std::move(contents), {limit_ / 10 * 9 - bytes, {}});
    present = counts.bytes_kept;
    log::debug("{}: removed {} results, {} MiB, that were not used for longest", folder_.string(),
               counts.removed, counts.bytes_removed >> 20);
  }
  size_.set(present);
}

}  // namespace rnmbake
