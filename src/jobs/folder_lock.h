// jobs/folder_lock.h - one run at a time writes to a folder.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace rnmbake {

/// Who holds a folder, as it stands in the folder's lock file; "" where that does not say.
struct LockHolder {
  std::string host, process, since, command;  // "2026-01-31 14:03:10 +0100"
};

struct FolderLockOptions {
  std::string command;         // of this run, for those who find the folder taken
  double wait_seconds = 0;     // for the holder to end
  std::function<bool()> stop;  // gives up waiting; may be empty
};

/// Holds FOLDER/.rnmbake.lock (flock) from its beginning to its end, and removes the file then. The system
/// lets go of it when the process ends, however it ends: a file that a killed run left is nobody's.
class FolderLock {
 public:
  static constexpr const char* file_name = ".rnmbake.lock";

  /// The folder must exist. Throws Error(lock_held) where another run holds it, and still does after the time
  /// to wait. Where a file system has no locks, or nothing can be written there, it warns and holds nothing.
  FolderLock(const std::filesystem::path& folder, const FolderLockOptions& options);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  [[nodiscard]] bool holds() const { return descriptor_ >= 0; }

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

/// Of a lock file, whether or not somebody holds it still.
[[nodiscard]] LockHolder read_holder(const std::filesystem::path& lock_file);

}  // namespace rnmbake
