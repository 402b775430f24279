#include "base/files.h"

#include "base/disk.h"
#include "base/error.h"
#include "base/leftovers.h"
#include "base/owner.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

namespace rnmbake {

namespace fs = std::filesystem;

namespace {

std::string reason(int error) {
  if (error == ENOSPC) return "the disk is full (ENOSPC); free some space or choose another folder";
  if (error == EDQUOT) return "the disk quota is used up; free some space or choose another folder";
  return std::strerror(error);  // NOLINT(concurrency-mt-unsafe): glibc's is thread-safe for known errors
}

[[noreturn]] void fail_writing(const fs::path& path, int error) {
  fail(ExitCode::io, "cannot write {}: {}", path.string(), reason(error));
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

std::string random_word() {
  static thread_local std::mt19937_64 generator{std::random_device{}()};
  return fmt::format("{:012x}", generator() >> 16);
}

/// Opens a new file beside `target` with the permissions that the user's umask gives (mkstemp's are 0600).
int create_beside(const fs::path& target, fs::path& temporary) {
  for (int attempt = 0; attempt < 16; ++attempt) {
    const std::string name = leftover_file + owner_word() + '-' + random_word() + target.extension().string();
    temporary = folder_of(target) / name;
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return descriptor;
    if (errno != EEXIST) break;
  }
  fail_writing(target, errno);
}

/// Whether both are plain files with the same bytes.
bool same_bytes(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(b, error)) ||
      fs::file_size(a, error) != fs::file_size(b, error))
    return false;
  std::ifstream first(a, std::ios::binary), second(b, std::ios::binary);
  std::vector<char> of_first(1 << 16), of_second(1 << 16);
  while (first && second) {
    first.read(of_first.data(), std::ssize(of_first));
    second.read(of_second.data(), std::ssize(of_second));
    const auto count = static_cast<std::size_t>(first.gcount());
    if (first.gcount() != second.gcount() || std::memcmp(of_first.data(), of_second.data(), count) != 0)
      return false;
  }
  return first.eof() && second.eof();
}

}  // namespace

void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);  // some file systems cannot; the data itself is already safe
  ::close(descriptor);
}

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)) {
  if (fs::is_directory(target_)) fail(ExitCode::io, "cannot write {}: it is a folder", target_.string());
  sweep_leftovers(folder_of(target_));
  descriptor_ = create_beside(target_, temporary_);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_writing(target_, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::write_at(std::string_view bytes, std::int64_t offset) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), offset);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_writing(target_, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
    offset += written;
  }
}

bool AtomicFile::commit() {
  // Builds (make, Ninja) do nothing over again that depends on a file whose time stays.
  if (same_bytes(temporary_, target_)) return false;  // the destructor removes the temporary
  // A library may have put another file in our file's place, so sync what the name stands for now.
  ::close(descriptor_);
  descriptor_ = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0 || ::fsync(descriptor_) != 0) fail_writing(target_, errno);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail_writing(target_, errno);
  committed_ = true;
  sync_folder(folder_of(target_));
  return true;
}

bool write_atomically(const fs::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  return file.commit();
}

bool write_atomically(const fs::path& path, const std::function<void(const fs::path&)>& writer) {
  AtomicFile file(path);
  try {
    writer(file.temporary());
  } catch (const std::exception&) {
    // Libraries seldom say why; with no room left the reason is plain.
    if (disk_is_full(folder_of(path))) fail_writing(path, ENOSPC);
    throw;
  }
  return file.commit();
}

void make_folders(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && fs::is_directory(folder, error)) return;
  fail(ExitCode::io, "cannot create the folder {}: {}", folder.string(),
       error ? reason(error.value()) : "a file has that name");
}

fs::path temp_root() {
  const char* variable = std::getenv("TMPDIR");
  return variable != nullptr && *variable != '\0' ? fs::path(variable) : fs::path("/tmp");
}

TempFolder::TempFolder(const fs::path& parent) {
  const fs::path root = fs::absolute(parent.empty() ? temp_root() : parent);
  sweep_leftovers(root);
  std::string name = (root / (leftover_folder + owner_word() + "-XXXXXX")).string();
  if (::mkdtemp(name.data()) == nullptr) {
    fail(ExitCode::io, "cannot create a temporary folder in {}: {}; point TMPDIR to a writable folder",
         root.string(), reason(errno));
  }
  path_ = name;
}

TempFolder::TempFolder(TempFolder&& other) noexcept : path_(std::move(other.path_)), kept_(other.kept_) {
  other.path_.clear();
}

TempFolder::~TempFolder() {
  if (path_.empty()) return;
  if (kept_) {
    mark_as_kept(path_);
    return;
  }
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace rnmbake
