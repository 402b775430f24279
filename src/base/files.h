// base/files.h - files that appear whole or not at all, and private temporary folders.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace rnmbake {

/// A file in the making: written under a temporary name in the same folder (same extension), moved to its
/// place by commit(), removed if that never happens. Failures are Error(io) with the path and the reason.
class AtomicFile {
 public:
  /// Creates the temporary file. The folder must exist and be writable.
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// For libraries that open a path themselves; they may replace the file.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

  void write(std::string_view bytes);

  /// At a place of the file, which may lie beyond its end.
  void write_at(std::string_view bytes, std::int64_t offset);

  /// fsync, then rename over the target; one that holds the same bytes is left alone, so that its time stays:
  /// false.
  bool commit();

 private:
  std::filesystem::path target_, temporary_;
  int descriptor_ = -1;
  bool committed_ = false;
};

/// The whole file at once. False: it held these bytes already.
bool write_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Lets `writer` fill the temporary path it is given, then moves the file to `path`. What the writer throws
/// passes through, except that a full disk is named as such. False: as above.
bool write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& writer);

/// The whole file. Error(io) if it cannot be read.
std::string read_text(const std::filesystem::path& path);

/// The last `bytes` bytes of a file, from a line's beginning on; empty if there is no such file.
std::string read_tail(const std::filesystem::path& path, std::size_t bytes);

/// Creates the folder and those above it. Error(io) names the first that cannot be.
void make_folders(const std::filesystem::path& folder);

/// fsync of a folder, so that names made in it outlast a crash; does nothing where the file system cannot.
void sync_folder(const std::filesystem::path& folder);

/// A folder that only this user can enter (mode 0700), gone with everything in it at the end of its scope.
class TempFolder {
 public:
  /// In `parent`, or where TMPDIR points (else /tmp).
  explicit TempFolder(const std::filesystem::path& parent = {});
  ~TempFolder();
  TempFolder(TempFolder&& other) noexcept;
  TempFolder& operator=(TempFolder&&) = delete;
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// From now on the folder outlives this object; for looking into failures.
  void keep() { kept_ = true; }

 private:
  std::filesystem::path path_;
  bool kept_ = false;
};

/// TMPDIR if it is set, else /tmp.
std::filesystem::path temp_root();

}  // namespace rnmbake
